#include "calibrate/experiment/view_mean.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/units.h"
#include "calibrate/experiment/heap_angle.h"

namespace repose::calibrate {
namespace {

using Views = std::span<const vision::ReposeAngle>;

bool counts(const vision::ReposeAngle& view) {
  return counts_in_mean(view.status) && view.angle_rad.has_value();
}

/// A number's values over the views that count.
template <typename Number>
std::vector<double> all_of(Views views, const Number& number) {
  std::vector<double> values;
  for (const vision::ReposeAngle& view : views) {
    if (!counts(view)) continue;
    if (const std::optional<double> value = number(view)) values.push_back(*value);
  }
  return values;
}

/// Mean and Student-t half-width of a number over the views; std::nullopt if none has it.
template <typename Number>
std::optional<Summary> summary_of(Views views, const Number& number) {
  const std::vector<double> values = all_of(views, number);
  if (values.empty()) return std::nullopt;
  return summarise(values);
}

template <typename Number>
std::optional<double> mean_of(Views views, const Number& number) {
  const auto summary = summary_of(views, number);
  return summary ? std::optional(summary->mean) : std::nullopt;
}

/// The median of the views' own half-widths and the Student-t half-width of their mean, combined in
/// quadrature.
double half_width(const Summary& summary, std::vector<double> own) {
  double common = 0;
  if (!own.empty()) {
    const auto middle = own.begin() + static_cast<std::ptrdiff_t>(own.size() / 2);
    std::nth_element(own.begin(), middle, own.end());
    common = *middle;
  }
  return std::hypot(summary.mean_uncertainty.value_or(0), common);
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
  for (const vision::ReposeAngle& view : views) {
    if (counts(view)) flank.points += (view.*side).points;
  }
  return flank;
}

/// The views' warnings, each once, with the number of views that have it.
std::vector<vision::Warning> warnings_of(Views views) {
  std::vector<vision::Warning> warnings;
  std::map<std::string, int> number;
  for (const vision::ReposeAngle& view : views) {
    if (!counts(view)) continue;
    for (const vision::Warning& warning : view.warnings) {
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
  for (const vision::ReposeAngle& first : views) {
    for (const vision::NamedAngle& named : first.definitions) {
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

void judge(Views views, vision::ReposeAngle& heap) {
  int flagged = 0, refused = 0;
  std::string why;
  for (const vision::ReposeAngle& view : views) {
    if (!counts(view)) {
      ++refused;
      if (why.empty()) why = view.reason;
    } else if (view.status == vision::MeasureStatus::flagged) {
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
  constexpr double kWide_rad = 5 * kDegree;
  const bool is_wide = heap.uncertainty_rad.value_or(0) > kWide_rad;
  if (is_wide) {
    heap.warnings.push_back(
        {.code = "wide_interval",
         .message = fmt::format("The angle is uncertain by ±{:.1f} degrees: look at the views; a "
                                "heap that is not round in plan has no single angle.",
                                to_degrees(*heap.uncertainty_rad))});
  }
  heap.status = is_wide || 2 * flagged >= count - refused ? vision::MeasureStatus::flagged
                                                          : vision::MeasureStatus::ok;
}

}  // namespace

vision::ReposeAngle mean_of_views(std::span<const vision::ReposeAngle> views) {
  vision::ReposeAngle heap;
  heap.definition = views.front().definition;
  heap.window = views.front().window;
  heap.method = views.front().method;
  heap.segmentation = views.front().segmentation;
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
  for (const vision::ReposeAngle& view : views) {
    heap.loose_particles = std::max(heap.loose_particles, view.loose_particles);
  }
  add_definitions(views, heap);
  judge(views, heap);
  return heap;
}

std::optional<double> sd_between_views(std::span<const vision::ReposeAngle> views) {
  const auto angle =
      summary_of(views, [](const vision::ReposeAngle& one) { return one.angle_rad; });
  return angle ? angle->sd : std::nullopt;
}

std::optional<Summary> summary_of_views(std::span<const vision::ReposeAngle> views,
                                        std::optional<double> vision::ReposeAngle::*number) {
  return summary_of(views, [number](const vision::ReposeAngle& one) { return one.*number; });
}

}  // namespace repose::calibrate
