#include "dem/experiment/surface_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "base/error_list.h"
#include "dem/experiment/flank_line.h"

namespace repose::dem {
namespace {

constexpr double kColumnsPerRadius = 20;
/// A line's foot counts for at most so many times as far from the crest as the outline reaches: a
/// layer's line is nearly level and would end metres away. Heaps of hazelnuts come to 1.2. Proved
/// by SurfaceProfile.TheBaseOfALayerEndsNearItsGrains.
constexpr double kFarthestFoot = 2;

struct Silhouette {
  std::vector<double> height;  ///< of the columns, m
  std::size_t crest = 0;
  double crest_m = 0;  ///< its height, smoothed
  double column_m = 0;
};

void check(const std::vector<ClumpSphere>& spheres, const SurfaceOptions& options) {
  base::ErrorList errors;
  errors.require(options.views >= 1,
                 fmt::format("views is {}. Rule: 1 or more. Fix: 18.", options.views));
  errors.require(
      options.window_from >= 0 && options.window_from < options.window_to && options.window_to <= 1,
      fmt::format("the window is {:g} to {:g} of the height. Rule: 0 <= from < to <= 1. "
                  "Fix: 0.2 to 0.8.",
                  options.window_from, options.window_to));
  bool is_above = false;
  for (const ClumpSphere& sphere : spheres) {
    is_above = is_above || sphere.centre.z() + sphere.radius > 0;
  }
  errors.require(is_above, "there is no heap: no sphere reaches above the ground");
  errors.throw_if_any();
}

double mean_radius(const std::vector<ClumpSphere>& spheres) {
  double sum = 0;
  for (const ClumpSphere& sphere : spheres) sum += sphere.radius;
  return sum / static_cast<double>(spheres.size());
}

/// The upper envelope along `across` (unit, level), cut down to what hangs together with its crest.
Silhouette silhouette(const std::vector<ClumpSphere>& spheres, const Vector& across) {
  double from = 1e300;
  double to = -1e300;
  for (const ClumpSphere& sphere : spheres) {
    from = std::min(from, across.dot(sphere.centre) - sphere.radius);
    to = std::max(to, across.dot(sphere.centre) + sphere.radius);
  }
  Silhouette view;
  view.column_m = mean_radius(spheres) / kColumnsPerRadius;
  std::vector<double> height(static_cast<std::size_t>((to - from) / view.column_m) + 1, 0.0);
  for (const ClumpSphere& sphere : spheres) {
    const double at = (across.dot(sphere.centre) - from) / view.column_m;
    const double reach = sphere.radius / view.column_m;
    const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(at - reach)));
    for (std::size_t k = first; k < height.size() && static_cast<double>(k) <= at + reach; ++k) {
      const double off = (static_cast<double>(k) - at) * view.column_m;
      const double dome = std::sqrt(std::max(0.0, sphere.radius * sphere.radius - off * off));
      height[k] = std::max(height[k], sphere.centre.z() + dome);
    }
  }
  const auto crest = std::max_element(height.begin(), height.end());
  auto first = crest;
  while (first != height.begin() && *(first - 1) > 0) --first;
  auto last = crest;
  while (last != height.end() && *last > 0) ++last;
  view.height.assign(first, last);
  return view;
}

/// Over as many columns as pictures' profiles are smoothed over, to find the crest and the window.
constexpr std::size_t kCrestParts = 40;
constexpr std::size_t kFlankParts = 60;

std::vector<double> moving_average(const std::vector<double>& values, std::size_t parts) {
  const std::size_t half = std::max<std::size_t>(3, values.size() / parts) / 2;
  std::vector<double> smooth(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t reach = std::min({half, k, values.size() - 1 - k});
    double sum = 0;
    for (std::size_t n = k - reach; n <= k + reach; ++n) sum += values[n];
    smooth[k] = sum / static_cast<double>(2 * reach + 1);
  }
  return smooth;
}

/// Middle of what reaches up to within 3 % of the top.
std::size_t crest_of(const std::vector<double>& smooth, double top_m) {
  std::size_t first = smooth.size();
  std::size_t last = 0;
  for (std::size_t k = 0; k < smooth.size(); ++k) {
    if (smooth[k] < .97 * top_m) continue;
    first = std::min(first, k);
    last = k;
  }
  return (first + last) / 2;
}

/// The columns from the crest to the right, or, read backwards, to the left.
Flank flank_from(const Silhouette& outline, const std::vector<double>& smooth, bool to_the_left) {
  const auto part = [&](const std::vector<double>& all) {
    const auto crest = static_cast<std::ptrdiff_t>(outline.crest);
    if (!to_the_left) return std::vector<double>(all.begin() + crest, all.end());
    return std::vector<double>(std::make_reverse_iterator(all.begin() + crest + 1), all.rend());
  };
  return {part(outline.height), part(smooth), outline.column_m, outline.crest_m};
}

/// What one view gives.
struct View {
  double height_m = 0;
  double angle_deg = 0;  ///< mean of the flanks, when there are any
  double foot_m = 0;
  int flanks = 0;
};

View measure_view(const std::vector<ClumpSphere>& spheres, const Vector& across,
                  const SurfaceOptions& options) {
  Silhouette outline = silhouette(spheres, across);
  const std::vector<double> for_crest = moving_average(outline.height, kCrestParts);
  outline.crest_m = *std::max_element(for_crest.begin(), for_crest.end());
  outline.crest = crest_of(for_crest, outline.crest_m);
  const std::vector<double> smooth = moving_average(outline.height, kFlankParts);
  View view;
  view.height_m = *std::max_element(outline.height.begin(), outline.height.end());
  for (const bool to_the_left : {true, false}) {
    const Flank flank = flank_from(outline, smooth, to_the_left);
    const std::optional<FlankLine> line = fit_flank_line(
        flank, options.window_from * outline.crest_m, options.window_to * outline.crest_m);
    if (!line) continue;
    ++view.flanks;
    view.angle_deg += std::atan(line->fall / outline.column_m) * 180 / std::numbers::pi;
    const double reach = static_cast<double>(flank.height.size());
    view.foot_m += std::min(line->at_crest / line->fall, kFarthestFoot * reach) * outline.column_m;
  }
  view.angle_deg /= std::max(1, view.flanks);
  view.foot_m /= std::max(1, view.flanks);
  return view;
}

}  // namespace

SurfaceReading measure_surface(const std::vector<ClumpSphere>& spheres,
                               const SurfaceOptions& options) {
  check(spheres, options);
  SurfaceReading reading;
  std::vector<double> angles;
  for (int k = 0; k < options.views; ++k) {
    const double turn = std::numbers::pi * k / options.views;
    const View view = measure_view(spheres, {std::cos(turn), std::sin(turn), 0}, options);
    reading.height_m = std::max(reading.height_m, view.height_m);
    if (k == 0) reading.first_view_deg = view.angle_deg;
    if (view.flanks == 0) continue;
    angles.push_back(view.angle_deg);
    reading.angle_deg += view.angle_deg;
    reading.base_radius_m += view.foot_m;
    reading.flanks += view.flanks;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, angles.size()));
  reading.angle_deg /= count;
  reading.base_radius_m /= count;
  double squares = 0;
  for (const double angle : angles) squares += std::pow(angle - reading.angle_deg, 2);
  reading.between_views_deg = std::sqrt(squares / std::max(1.0, count - 1));
  return reading;
}

}  // namespace repose::dem
