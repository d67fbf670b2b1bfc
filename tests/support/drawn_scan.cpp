#include "tests/support/drawn_scan.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "tests/support/heap_random.h"

namespace repose::testing {

namespace {

double slope_of(double angle_deg) { return std::tan(angle_deg * std::numbers::pi / 180); }

template <typename Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace

HeightOver cone_surface(double angle_deg, double height) {
  const double slope = slope_of(angle_deg);
  return [=](double x, double y) { return std::max(0.0, height - slope * std::hypot(x, y)); };
}

double cone_volume(double angle_deg, double height) {
  const double radius = height / slope_of(angle_deg);
  return std::numbers::pi * radius * radius * height / 3;
}

std::vector<base::Corner> drawn_scan(const ScanDraft& draft) {
  Random random(draft.seed);
  std::vector<base::Corner> points;
  points.reserve(draft.points);
  for (std::size_t k = 0; k < draft.points; ++k) {
    const double x = random.uniform(-draft.half_side, draft.half_side);
    const double y = random.uniform(-draft.half_side, draft.half_side);
    base::Corner place = {x, y, draft.surface(x, y)};
    for (double& coordinate : place) coordinate += random.normal(0, draft.noise);
    points.push_back(place);
  }
  return points;
}

void add_outliers(std::vector<base::Corner>& points, std::size_t count, double half_side,
                  std::uint64_t seed) {
  Random random(seed);
  for (std::size_t k = 0; k < count; ++k) {
    base::Corner place{};
    for (double& coordinate : place) coordinate = random.uniform(-half_side, half_side);
    points.push_back(place);
  }
}

std::vector<base::Corner> kept(const std::vector<base::Corner>& points,
                               const std::function<bool(const base::Corner&)>& keeps) {
  std::vector<base::Corner> found;
  std::copy_if(points.begin(), points.end(), std::back_inserter(found), keeps);
  return found;
}

std::vector<base::Corner> turned(std::vector<base::Corner> points, double scale) {
  const Eigen::AngleAxisd turn(130 * std::numbers::pi / 180, Eigen::Vector3d(1, 2, 3).normalized());
  for (base::Corner& point : points) {
    const Eigen::Vector3d place = scale * (turn * Eigen::Vector3d(point[0], point[1], point[2]) +
                                           Eigen::Vector3d(40, -70, 9));
    point = {place.x(), place.y(), place.z()};
  }
  return points;
}

std::string ply_of(const std::vector<base::Corner>& points,
                   const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float "
      "y\n"
      "property float z\n",
      points.size());
  if (!triangles.empty()) {
    bytes +=
        fmt::format("element face {}\nproperty list uchar int vertex_indices\n", triangles.size());
  }
  bytes += "end_header\n";
  for (const base::Corner& point : points) {
    for (const double coordinate : point) append(bytes, static_cast<float>(coordinate));
  }
  for (const auto& triangle : triangles) {
    append(bytes, std::uint8_t{3});
    for (const std::uint32_t corner : triangle) append(bytes, static_cast<std::int32_t>(corner));
  }
  return bytes;
}

}  // namespace repose::testing
