#include "calibrate/particles/positions_angle.h"

#include <atomic>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/experiment/heap_angle.h"
#include "calibrate/experiment/view_mean.h"
#include "dem/state/state_file.h"
#include "render/renderer.h"
#include "render/scene/extent.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

/// Whether repose wrote the file, so that unit, plate and up direction are known.
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

/// Adds warnings based on the particle positions to those of the views.
void judge(const StandingHeap& standing, vision::ReposeAngle& heap) {
  if (heap.status == vision::MeasureStatus::refused) return;
  if (standing.in_the_air > 0) {
    heap.warnings.push_back(
        {.code = "in_the_air",
         .message = fmt::format("{} particles touch neither the heap nor the plate and are left "
                                "out: the heap may not be at rest. Take a later time step.",
                                standing.in_the_air)});
    heap.status = vision::MeasureStatus::flagged;
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
    heap.status = vision::MeasureStatus::flagged;
  }
}

/// The scale of rendered views is exact; sizes vary between views.
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
    const auto found = summary_of_views(measured.views, pixels);
    if (!found) return std::nullopt;
    // Edges are drawn to within half a pixel.
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
                             .views = std::vector<vision::ReposeAngle>(kHeapViews),
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
    vision::ReposeAngle& kept = measured.views[static_cast<std::size_t>(view)];
    kept = std::move(taken.angle);
    if (view == 0) {
      measured.first_picture = std::move(taken.picture);
    } else {
      kept.outline = {};
      kept.upper_edge = {};
      kept.left.edge = {};
      kept.right.edge = {};
    }
    if (report) report(static_cast<double>(++done) / kHeapViews);
  });
  measured.between_views_rad = sd_between_views(measured.views);
  measured.angle = mean_of_views(measured.views);
  judge(measured.file.heap, measured.angle);
  if (measured.file.heap.has_unit) measured.mm_per_px = kMmPerM * session.m_per_px();
  measured.sizes = sizes_of(measured);
  return measured;
}

}  // namespace repose::calibrate
