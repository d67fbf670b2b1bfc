#include "calibrate/particles/positions_angle.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/experiment/heap_angle.h"
#include "calibrate/statistics/summary.h"
#include "dem/state/state_file.h"
#include "render/renderer.h"
#include "render/scene/extent.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

/// Whether repose wrote a file, which then knows its unit, its plate and what is up.
bool is_state_file(const fs::path& file) {
  if (file.extension() != ".vtp") return false;
  const auto text = base::read_file_if_there(file);
  return text && text->find("repose_state_format") != std::string::npos;
}

PositionsFile state_in(const fs::path& file, const PositionsOptions& options) {
  const bool is_told = !options.reading.unit.empty() || options.reading.step ||
                       options.reading.diameter_mm || options.placement.plate ||
                       options.placement.up != Up::z;
  if (is_told) {
    base::refuse(file, "is a state of repose, which knows its unit, its plate and what is up",
                 "leave out what is told of files of other programs.");
  }
  PositionsFile found;
  found.heap.scene = render::scene_of(dem::read_state(file));
  found.heap.has_unit = true;
  found.heap.plate = render::ground_m(found.heap.scene).value_or(0);
  found.heap.is_plate_given = true;
  found.heap.grains = found.heap.scene.grains.size();
  for (const render::PlacedGrain& grain : found.heap.scene.grains) {
    found.heap.spheres +=
        found.heap.scene.shapes[static_cast<std::size_t>(grain.shape)].spheres.size();
  }
  found.has_clumps = found.heap.spheres > found.heap.grains;
  found.format = kStateFormat;
  found.unit = "m";
  return found;
}

using Views = std::span<const PositionsView>;

bool counts(const PositionsView& view) {
  return counts_in_mean(view.angle.status) && view.angle.angle_rad.has_value();
}

/// Mean and Student's half-width of what the views have of a number; none of none.
template <typename Number>
std::optional<Summary> summary_of(Views views, const Number& number) {
  std::vector<double> values;
  for (const PositionsView& view : views) {
    if (!counts(view)) continue;
    if (const std::optional<double> value = number(view.angle)) values.push_back(*value);
  }
  if (values.empty()) return std::nullopt;
  return summarise(values);
}

template <typename Number>
std::optional<double> mean_of(Views views, const Number& number) {
  const auto summary = summary_of(views, number);
  return summary ? std::optional(summary->mean) : std::nullopt;
}

/// The median of the views' own half-widths, and Student's of their mean, as two parts.
double half_width(const Summary& summary, std::vector<double> own) {
  double common = 0;
  if (!own.empty()) {
    const auto middle = own.begin() + static_cast<std::ptrdiff_t>(own.size() / 2);
    std::nth_element(own.begin(), middle, own.end());
    common = *middle;
  }
  return std::hypot(summary.mean_uncertainty.value_or(0), common);
}

template <typename Number>
std::vector<double> all_of(Views views, const Number& number) {
  std::vector<double> values;
  for (const PositionsView& view : views) {
    if (!counts(view)) continue;
    if (const std::optional<double> value = number(view.angle)) values.push_back(*value);
  }
  return values;
}

vision::Flank flank_of(Views views, vision::Flank vision::ReposeAngle::*side) {
  const auto angle = [side](const vision::ReposeAngle& one) { return (one.*side).angle_rad; };
  const auto own = [side](const vision::ReposeAngle& one) { return (one.*side).uncertainty_rad; };
  vision::Flank flank;
  const auto summary = summary_of(views, angle);
  if (!summary) {
    flank.reason = "no view has it";
    return flank;
  }
  flank.status = vision::FlankStatus::ok;
  flank.angle_rad = summary->mean;
  flank.uncertainty_rad = half_width(*summary, all_of(views, own));
  flank.least_squares_rad = mean_of(
      views, [side](const vision::ReposeAngle& one) { return (one.*side).least_squares_rad; });
  flank.robust_rad =
      mean_of(views, [side](const vision::ReposeAngle& one) { return (one.*side).robust_rad; });
  flank.r2 = mean_of(views, [side](const vision::ReposeAngle& one) { return (one.*side).r2; });
  flank.bend_rad =
      mean_of(views, [side](const vision::ReposeAngle& one) { return (one.*side).bend_rad; });
  for (const PositionsView& view : views) {
    if (counts(view)) flank.points += (view.angle.*side).points;
  }
  return flank;
}

/// What the views warn of, each once, with the number of views that do.
std::vector<vision::Warning> warnings_of(Views views) {
  std::vector<vision::Warning> warnings;
  std::map<std::string, int> number;
  for (const PositionsView& view : views) {
    if (!counts(view)) continue;
    for (const vision::Warning& warning : view.angle.warnings) {
      if (++number[warning.code] == 1) warnings.push_back(warning);
    }
  }
  for (vision::Warning& warning : warnings) {
    warning.message =
        fmt::format("In {} of {} views: {}", number[warning.code], views.size(), warning.message);
  }
  return warnings;
}

void add_definitions(Views views, vision::ReposeAngle& heap) {
  for (const PositionsView& first : views) {
    for (const vision::NamedAngle& named : first.angle.definitions) {
      const auto is_same = [&](const vision::NamedAngle& one) { return one.name == named.name; };
      if (std::ranges::any_of(heap.definitions, is_same)) continue;
      const auto angle = summary_of(views, [&](const vision::ReposeAngle& one) {
        const auto found = std::ranges::find_if(one.definitions, is_same);
        return found == one.definitions.end() ? std::nullopt : std::optional(found->angle_rad);
      });
      if (!angle || 2 * static_cast<std::size_t>(angle->n) < views.size()) continue;
      heap.definitions.push_back(
          {.name = named.name, .description = named.description, .angle_rad = angle->mean});
    }
  }
}

void judge(Views views, const StandingHeap& standing, vision::ReposeAngle& heap) {
  int flagged = 0, refused = 0;
  std::string why;
  for (const PositionsView& view : views) {
    if (!counts(view)) {
      ++refused;
      if (why.empty()) why = view.angle.reason;
    } else if (view.angle.status == vision::MeasureStatus::flagged) {
      ++flagged;
    }
  }
  const auto count = static_cast<int>(views.size());
  if (2 * refused > count) {
    vision::ReposeAngle none;
    none.reason = fmt::format("{} of {} views give no angle; the first: {}", refused, count, why);
    none.window = heap.window;
    none.method = heap.method;
    heap = std::move(none);
    return;
  }
  heap.warnings = warnings_of(views);
  if (refused > 0) {
    heap.warnings.push_back({.code = "views_refused",
                             .message = fmt::format("{} of {} views give no angle; the first: {}",
                                                    refused, count, why)});
  }
  if (standing.in_the_air > 0) {
    heap.warnings.push_back(
        {.code = "in_the_air",
         .message = fmt::format("{} particles touch neither the heap nor the plate and are left "
                                "out: the heap may not be at rest. Take a later time step.",
                                standing.in_the_air)});
  }
  constexpr double kUsual_percent = 10;
  if (standing.deep_percent > kUsual_percent) {
    heap.warnings.push_back(
        {.code = "overlaps",
         .message =
             fmt::format("{:.0f} % of the spheres that touch overlap by more than two fifths "
                         "of a radius. Fine for clumps without a column clump; else the "
                         "column of radii may hold diameters.",
                         standing.deep_percent)});
  }
  constexpr double kWide_rad = 5 * kDegree;
  const bool is_wide = heap.uncertainty_rad.value_or(0) > kWide_rad;
  if (is_wide) {
    heap.warnings.push_back(
        {.code = "wide_interval",
         .message = fmt::format("The angle is uncertain by ±{:.1f} degrees: look at the views; a "
                                "heap that is not round in plan has no single angle.",
                                to_degrees(*heap.uncertainty_rad))});
  }
  const bool is_flagged = is_wide || 2 * flagged >= count - refused || standing.in_the_air > 0 ||
                          standing.deep_percent > kUsual_percent;
  heap.status = is_flagged ? vision::MeasureStatus::flagged : vision::MeasureStatus::ok;
}

vision::ReposeAngle heap_of(Views views, const StandingHeap& standing) {
  vision::ReposeAngle heap;
  heap.definition = views.front().angle.definition;
  heap.window = views.front().angle.window;
  heap.method = views.front().angle.method;
  heap.segmentation = views.front().angle.segmentation;
  const auto angle =
      summary_of(views, [](const vision::ReposeAngle& one) { return one.angle_rad; });
  if (angle) {
    heap.angle_rad = angle->mean;
    heap.uncertainty_rad = half_width(*angle, all_of(views, [](const vision::ReposeAngle& one) {
      return one.own_uncertainty_rad ? one.own_uncertainty_rad : one.uncertainty_rad;
    }));
    heap.own_uncertainty_rad = heap.uncertainty_rad;
    heap.camera_uncertainty_rad = 0;
  }
  heap.left = flank_of(views, &vision::ReposeAngle::left);
  heap.right = flank_of(views, &vision::ReposeAngle::right);
  const auto mean = [&](std::optional<double> vision::ReposeAngle::*number) {
    return mean_of(views, [number](const vision::ReposeAngle& one) { return one.*number; });
  };
  heap.ground_tilt_rad = mean(&vision::ReposeAngle::ground_tilt_rad);
  heap.height_px = mean(&vision::ReposeAngle::height_px);
  heap.base_px = mean(&vision::ReposeAngle::base_px);
  heap.grain_px = mean(&vision::ReposeAngle::grain_px);
  heap.confidence = mean_of(views, [](const vision::ReposeAngle& one) {
                      return std::optional(one.confidence);
                    }).value_or(0);
  for (const PositionsView& view : views) {
    heap.loose_particles = std::max(heap.loose_particles, view.angle.loose_particles);
  }
  add_definitions(views, heap);
  judge(views, standing, heap);
  return heap;
}

/// The scale of drawn views is exact; sizes scatter between them.
vision::HeapSizes sizes_of(const MeasuredPositions& measured) {
  vision::HeapSizes sizes;
  if (measured.mm_per_px == 0) {
    sizes.reason = "neither the file nor anybody else says in which unit its lengths are";
    return sizes;
  }
  if (measured.angle.status == vision::MeasureStatus::refused) return sizes;
  sizes.mm_per_px = vision::Estimate{.value = measured.mm_per_px, .uncertainty = 0};
  const auto length =
      [&](std::optional<double> vision::ReposeAngle::*pixels) -> std::optional<vision::Estimate> {
    const auto found = summary_of(measured.views,
                                  [pixels](const vision::ReposeAngle& one) { return one.*pixels; });
    if (!found) return std::nullopt;
    // An edge is drawn within half a pixel.
    const double edge_px = std::hypot(found->mean_uncertainty.value_or(0), .5);
    return vision::Estimate{.value = measured.mm_per_px * found->mean,
                            .uncertainty = measured.mm_per_px * edge_px};
  };
  sizes.height_mm = length(&vision::ReposeAngle::height_px);
  sizes.base_mm = length(&vision::ReposeAngle::base_px);
  if (sizes.height_mm && sizes.base_mm) {
    const double volume = vision::cone_volume_ml(sizes.base_mm->value, sizes.height_mm->value);
    const double part = std::hypot(sizes.height_mm->uncertainty / sizes.height_mm->value,
                                   2 * sizes.base_mm->uncertainty / sizes.base_mm->value);
    sizes.cone_volume_ml = vision::Estimate{.value = volume, .uncertainty = volume * part};
  }
  return sizes;
}

}  // namespace

std::string PositionsFile::text() const {
  std::string said = fmt::format("{}: {} particles", format, heap.grains);
  if (has_clumps) said += fmt::format(" of {} spheres", heap.spheres);
  if (!step.empty()) {
    said += steps > 1 ? fmt::format(", time step {} of {}", step, steps)
                      : fmt::format(", time step {}", step);
  }
  if (!is_state()) {
    said += fmt::format("; {} is up, the plate {} at {:.4g}{}", name_of(up),
                        heap.is_plate_given ? "given" : "found", heap.plate,
                        unit.empty() ? "" : " " + unit);
  }
  if (heap.below_plate > 0) {
    said += fmt::format("; left out: {} below the plate", heap.below_plate);
  }
  return said;
}

PositionsFile read_positions(const fs::path& file, const PositionsOptions& options) {
  if (is_state_file(file)) return state_in(file, options);
  const Particles particles = read_particles(file, options.reading);
  PositionsFile found;
  found.heap = standing_heap(file.string(), particles, options.placement);
  found.format = particles.format;
  found.unit = particles.unit;
  found.step = particles.step;
  found.steps = particles.steps;
  found.has_clumps = !particles.grains.empty();
  found.up = options.placement.up;
  return found;
}

MeasuredPositions measure_positions(const fs::path& file, const PositionsOptions& options,
                                    const vision::MeasureOptions& measuring,
                                    const std::function<void(double fraction)>& report) {
  MeasuredPositions measured{.file = read_positions(file, options),
                             .views = std::vector<PositionsView>(kHeapViews),
                             .first_picture = {},
                             .between_views_rad = {},
                             .angle = {},
                             .mm_per_px = 0,
                             .sizes = {}};
  const HeapViewSession session(std::move(measured.file.heap.scene), {.views = kHeapViews});
  measured.file.heap.scene = {};
  // Contexts are costly to make, and each belongs to one thread.
  tbb::enumerable_thread_specific<render::Renderer> renderers;
  std::atomic<int> done = 0;
  tbb::parallel_for(0, kHeapViews, [&](int view) {
    TakenView taken = session.take(renderers.local(), view, measuring);
    PositionsView& kept = measured.views[static_cast<std::size_t>(view)];
    kept.azimuth_rad = std::numbers::pi * view / kHeapViews;
    kept.angle = std::move(taken.angle);
    if (view == 0) {
      measured.first_picture = std::move(taken.picture);
    } else {
      kept.angle.outline = {};
      kept.angle.upper_edge = {};
      kept.angle.left.edge = {};
      kept.angle.right.edge = {};
    }
    if (report) report(static_cast<double>(++done) / kHeapViews);
  });
  const auto angle =
      summary_of(measured.views, [](const vision::ReposeAngle& one) { return one.angle_rad; });
  if (angle) measured.between_views_rad = angle->sd;
  measured.angle = heap_of(measured.views, measured.file.heap);
  if (measured.file.heap.has_unit) measured.mm_per_px = kMmPerM * session.m_per_px();
  measured.sizes = sizes_of(measured);
  return measured;
}

}  // namespace repose::calibrate
