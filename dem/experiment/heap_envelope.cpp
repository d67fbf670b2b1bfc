#include "dem/experiment/heap_envelope.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "base/input_error.h"

namespace repose::dem {
namespace {

constexpr double kColumnsPerRadius = 20;

void check(const std::vector<ClumpSphere>& spheres, int views) {
  base::Faults errors;
  errors.require(views >= 1, {.subject = "views",
                              .value = fmt::format("is {}", views),
                              .rule = "1 or more",
                              .fix = "18."});
  const bool is_above = std::any_of(spheres.begin(), spheres.end(), [](const ClumpSphere& sphere) {
    return sphere.centre.z() + sphere.radius > 0;
  });
  errors.require(is_above, {.value = "there is no heap: no sphere reaches above the ground"});
  errors.throw_if_any();
}

double mean_radius(const std::vector<ClumpSphere>& spheres) {
  double sum = 0;
  for (const ClumpSphere& sphere : spheres) sum += sphere.radius;
  return sum / static_cast<double>(spheres.size());
}

/// Raises the columns under a sphere to its upper side; `at` is its centre's column.
void raise_columns(std::vector<double>& height_m, const ClumpSphere& sphere, double at,
                   double column_m) {
  const double reach = sphere.radius / column_m;
  const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(at - reach)));
  for (std::size_t k = first; k < height_m.size() && static_cast<double>(k) <= at + reach; ++k) {
    const double off = (static_cast<double>(k) - at) * column_m;
    const double dome = std::sqrt(std::max(0.0, sphere.radius * sphere.radius - off * off));
    height_m[k] = std::max(height_m[k], sphere.centre.z() + dome);
  }
}

/// The columns around the highest one, up to the first gap on either side.
std::vector<double> connected_part(const std::vector<double>& height_m) {
  const auto highest = std::max_element(height_m.begin(), height_m.end());
  auto first = highest;
  while (first != height_m.begin() && *(first - 1) > 0) --first;
  auto last = highest;
  while (last != height_m.end() && *last > 0) ++last;
  return {first, last};
}

HeapEnvelope envelope_at(const std::vector<ClumpSphere>& spheres, double azimuth_rad) {
  const Vector across(std::cos(azimuth_rad), std::sin(azimuth_rad), 0);
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  for (const ClumpSphere& sphere : spheres) {
    from = std::min(from, across.dot(sphere.centre) - sphere.radius);
    to = std::max(to, across.dot(sphere.centre) + sphere.radius);
  }
  const double column_m = mean_radius(spheres) / kColumnsPerRadius;
  std::vector<double> height_m(static_cast<std::size_t>((to - from) / column_m) + 1, 0.0);
  for (const ClumpSphere& sphere : spheres) {
    const double at = (across.dot(sphere.centre) - from) / column_m;
    raise_columns(height_m, sphere, at, column_m);
  }
  return {.azimuth_rad = azimuth_rad, .column_m = column_m, .height_m = connected_part(height_m)};
}

}  // namespace

std::vector<HeapEnvelope> heap_envelopes(const std::vector<ClumpSphere>& spheres, int views) {
  check(spheres, views);
  std::vector<HeapEnvelope> envelopes;
  envelopes.reserve(static_cast<std::size_t>(views));
  for (int view = 0; view < views; ++view) {
    envelopes.push_back(envelope_at(spheres, std::numbers::pi * view / views));
  }
  return envelopes;
}

double height_m(const std::vector<HeapEnvelope>& envelopes) {
  double highest = 0;
  for (const HeapEnvelope& envelope : envelopes) {
    for (const double height : envelope.height_m) highest = std::max(highest, height);
  }
  return highest;
}

}  // namespace repose::dem
