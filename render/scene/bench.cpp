#include "render/scene/bench.h"

#include <algorithm>
#include <cmath>

#include "render/scene/extent.h"

namespace repose::render {
namespace {

using dem::Vector;

double greatest_reach_m(const std::vector<Scene>& moments) {
  double greatest = 0;
  for (const Scene& moment : moments) {
    for (const double reach : reaches_of(moment)) greatest = std::max(greatest, reach);
  }
  return greatest;
}

/// Bounding box of the grains over all moments, in a wall's frame.
Eigen::AlignedBox3d way_on(const std::vector<Scene>& moments, std::size_t wall) {
  Eigen::AlignedBox3d way;
  for (const Scene& moment : moments) {
    const std::vector<double> reaches_m = reaches_of(moment);
    const dem::Pose& pose = moment.walls[wall].pose;
    for (const PlacedGrain& grain : moment.grains) {
      const Vector place = pose.orientation.conjugate() * (grain.pose.position - pose.position);
      const Vector reach = Vector::Constant(reaches_m[static_cast<std::size_t>(grain.shape)]);
      way.extend(Eigen::AlignedBox3d(place - reach, place + reach));
    }
  }
  return way;
}

bool turns_in(const std::vector<Scene>& moments, std::size_t wall) {
  constexpr double kStill_rad = 1e-6;
  const dem::Quaternion& first = moments.front().walls[wall].pose.orientation;
  return std::any_of(moments.begin(), moments.end(), [&](const Scene& moment) {
    return moment.walls[wall].pose.orientation.angularDistance(first) > kStill_rad;
  });
}

Eigen::AlignedBox3d bounds_of(const PlacedWall& wall) {
  Eigen::AlignedBox3d bounds;
  const auto* box = std::get_if<dem::Box>(&wall.shape);
  if (box == nullptr) return bounds;
  const Vector reach = wall.pose.orientation.toRotationMatrix().cwiseAbs() * box->half_size;
  return {wall.pose.position - reach, wall.pose.position + reach};
}

}  // namespace

Bench::Bench(const std::vector<Scene>& moments) {
  for (const Scene& moment : moments) {
    setting_.extent.extend(grain_bounds(moment, Eigen::Matrix3d::Identity()));
  }
  const std::size_t walls = moments.front().walls.size();
  // Removing a wall renumbers the others. That happens in heap runs, whose plates are finite.
  const bool is_alike = std::all_of(moments.begin(), moments.end(), [walls](const Scene& moment) {
    return moment.walls.size() == walls;
  });
  for (std::size_t k = 0; k < walls && is_alike; ++k) {
    turns_.push_back(turns_in(moments, k));
    plates_.push_back(plate_of(moments, k));
  }
  set_floor(moments);
}

std::optional<Bench::Plate> Bench::plate_of(const std::vector<Scene>& moments,
                                            std::size_t wall) const {
  // How far a plate extends beyond the grains' paths, and its thickness, in reaches of the largest
  // grain.
  constexpr double kBeyond = 4, kSameEdgeTolerance = 6, kBehindHinge = 2, kThick = 1.5;
  constexpr double kOfWay = .75;  // of the extent: a plate that does not rotate is longer
  constexpr double kMuchWider = 10;
  const PlacedWall& placed = moments.front().walls[wall];
  const double reach = greatest_reach_m(moments);
  const Eigen::AlignedBox3d way = way_on(moments, wall);
  if (way.isEmpty()) return std::nullopt;
  const double half_width = .5 * way.sizes().y() + kSameEdgeTolerance * reach;
  if (const auto* box = std::get_if<dem::Box>(&placed.shape)) {
    if (box->half_size.y() < kMuchWider * half_width) return std::nullopt;
    return Plate{.middle = {0, way.center().y(), 0},
                 .half_size = {box->half_size.x(), half_width, box->half_size.z()}};
  }
  if (!std::holds_alternative<dem::Plane>(placed.shape) || is_pane(placed)) return std::nullopt;
  double from = way.min().x(), to = way.max().x();
  if (turns_[wall]) {
    from = std::min(from - kBeyond * reach, -kBehindHinge * reach);
    to = std::max(to + kBeyond * reach, kBehindHinge * reach);
  } else {
    const double beyond = std::max(kBeyond * reach, kOfWay * setting_.extent.diagonal().norm());
    from -= beyond;
    to += beyond;
  }
  const double half_thickness = .5 * kThick * reach;
  return Plate{.middle = {.5 * (from + to), way.center().y(), -half_thickness},
               .half_size = {.5 * (to - from), half_width, half_thickness}};
}

PlacedWall Bench::cut(const PlacedWall& wall, std::size_t number) const {
  if (number >= plates_.size() || !plates_[number]) return wall;
  const Plate& plate = *plates_[number];
  return {.shape = dem::Box{.half_size = plate.half_size},
          .pose = {.position = wall.pose.position + wall.pose.orientation * plate.middle,
                   .orientation = wall.pose.orientation}};
}

/// The table is below everything, and plates that rotate are fully visible.
void Bench::set_floor(const std::vector<Scene>& moments) {
  Eigen::AlignedBox3d turning;
  setting_.floor_m = setting_.extent.min().z();
  for (const Scene& moment : moments) {
    for (std::size_t k = 0; k < moment.walls.size(); ++k) {
      const Eigen::AlignedBox3d bounds = bounds_of(cut(moment.walls[k], k));
      if (bounds.isEmpty()) continue;
      setting_.floor_m = std::min(setting_.floor_m, bounds.min().z());
      if (k < turns_.size() && turns_[k]) turning.extend(bounds);
    }
  }
  setting_.extent.extend(turning);
}

Scene Bench::set(Scene moment) const {
  for (std::size_t k = 0; k < moment.walls.size(); ++k) moment.walls[k] = cut(moment.walls[k], k);
  moment.setting = setting_;
  return moment;
}

}  // namespace repose::render
