#include "dem/wall/facets.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "base/input_error.h"

namespace repose::dem {

namespace {

/// Nearest point of a box about the origin with half sides `half`, in any number of dimensions.
template <typename Point>
struct Nearest {
  double distance;
  Point normal;
};

template <typename Point>
Nearest<Point> nearest_on_box(const Point& half, const Point& point) {
  const Point outside = point - point.cwiseMax(-half).cwiseMin(half);
  const double distance = outside.norm();
  if (distance > 0) return {distance, outside / distance};
  // Inside: the nearest face; of equally near ones the first.
  const Point depth = half - point.cwiseAbs();
  Eigen::Index axis = 0;
  const double least = depth.minCoeff(&axis);
  Point normal = Point::Zero();
  normal[axis] = point[axis] < 0 ? -1 : 1;
  return {-least, normal};
}

}  // namespace

Closest closest(const Plane& /*plane*/, const Vector& point) { return closest_above(0, point); }

Closest closest(const Box& box, const Vector& point) {
  const Vector& half = box.half_size;
  if (point.z() > half.z() && std::abs(point.x()) <= half.x() && std::abs(point.y()) <= half.y()) {
    return closest_above(half.z(), point);
  }
  const auto [distance, normal] = nearest_on_box<Vector>(half, point);
  return {.distance = distance, .normal = normal};
}

Closest closest(const Tube& tube, const Vector& point) {
  using Point = Eigen::Vector2d;
  const double from_axis = std::sqrt(point.x() * point.x() + point.y() * point.y());
  const Closest within = closest_within(tube.inner_radius, from_axis, point);
  if (from_axis <= tube.inner_radius && point.z() >= 0 && point.z() <= tube.height) return within;
  const Point half(tube.thickness / 2, tube.height / 2);
  const Point middle(tube.inner_radius + half.x(), half.y());
  const auto [distance, normal] = nearest_on_box<Point>(half, Point(from_axis, point.z()) - middle);
  const Vector outwards = -within.normal;
  return {.distance = distance, .normal = normal.x() * outwards + normal.y() * Vector::UnitZ()};
}

namespace {

constexpr int kMaxCells = 512;

void check(const SphereBed& bed) {
  if (bed.spheres.empty()) throw base::InputError({.value = "a bed of spheres has none"});
  for (std::size_t k = 0; k < bed.spheres.size(); ++k) {
    const FixedSphere& sphere = bed.spheres[k];
    if (sphere.radius > 0 && 4 * sphere.radius < bed.tile && sphere.centre.allFinite()) continue;
    throw base::InputError(
        {.value = fmt::format("a bed's sphere {} has a radius of {:g} m", k, sphere.radius),
         .rule = fmt::format("above 0, and less than a quarter of the tile, {:g} m", bed.tile),
         .fix = "a larger tile."});
  }
}

}  // namespace

BedFacets::BedFacets(const SphereBed& bed) : bed_(bed) {
  check(bed);
  top_ = -kEndless;
  for (const FixedSphere& sphere : bed_.spheres) {
    top_ = std::max(top_, sphere.centre.z() + sphere.radius);
    widest_ = std::max(widest_, sphere.radius);
  }
  cells_ = std::clamp(static_cast<int>(bed_.tile / (2 * widest_)), 1, kMaxCells);
  spheres_in_.resize(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_));
  for (int k = 0; k < static_cast<int>(bed_.spheres.size()); ++k) {
    const Vector& centre = sphere(k).centre;
    spheres_in_[cell_at(cell_of(centre.x()), cell_of(centre.y()))].push_back(k);
  }
}

int BedFacets::cell_of(double coordinate) const {
  const double turns = coordinate / bed_.tile;
  const int cell = static_cast<int>((turns - std::floor(turns)) * cells_);
  return std::min(cell, cells_ - 1);
}

Vector BedFacets::from_centre(int facet, const Vector& point) const {
  Vector away = point - sphere(facet).centre;
  away.x() -= bed_.tile * std::round(away.x() / bed_.tile);
  away.y() -= bed_.tile * std::round(away.y() / bed_.tile);
  return away;
}

void BedFacets::near(const Vector& point, double distance, std::vector<int>& facets) const {
  facets.clear();
  if (point.z() - top_ > distance) return;
  const double far = distance + widest_;
  const int reach = std::min(static_cast<int>(std::ceil(far * cells_ / bed_.tile)), cells_ / 2);
  const int x = cell_of(point.x());
  const int y = cell_of(point.y());
  const int last = std::min(2 * reach + 1, cells_);
  for (int j = 0; j < last; ++j) {
    for (int i = 0; i < last; ++i) {
      const int row = (y - reach + j + cells_) % cells_;
      const int column = (x - reach + i + cells_) % cells_;
      for (const int k : spheres_in_[cell_at(column, row)]) {
        if (closest(k, point).distance < distance) facets.push_back(k);
      }
    }
  }
  std::sort(facets.begin(), facets.end());
}

Closest BedFacets::closest(int facet, const Vector& point) const {
  const Vector away = from_centre(facet, point);
  const double centre_x = point.x() - away.x();
  const double distance = away.norm();
  if (distance == 0 || centre_x < bed_.from_x || centre_x > bed_.to_x) {
    return {.distance = kEndless, .normal = Vector::UnitZ()};
  }
  return {.distance = distance - sphere(facet).radius, .normal = away / distance};
}

namespace {

Mesh with_shared_corners(const Mesh& mesh) {
  Mesh shared;
  std::map<std::array<double, 3>, int> numbers;
  std::vector<int> number_of;
  for (const Vector& vertex : mesh.vertices) {
    const auto [known, is_new] = numbers.try_emplace({vertex.x(), vertex.y(), vertex.z()},
                                                     static_cast<int>(shared.vertices.size()));
    if (is_new) shared.vertices.push_back(vertex);
    number_of.push_back(known->second);
  }
  for (const auto& triangle : mesh.triangles) {
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = number_of.at(static_cast<std::size_t>(triangle[k]));
    }
    shared.triangles.push_back(corners);
  }
  return shared;
}

void check(const Mesh& mesh) {
  if (mesh.triangles.empty()) throw base::InputError({.value = "a mesh wall has no triangles"});
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto& [a, b, c] = mesh.triangles[k];
    const auto at = [&mesh](int corner) { return mesh.vertices[static_cast<std::size_t>(corner)]; };
    const Vector area = (at(b) - at(a)).cross(at(c) - at(a));
    if (!(area.norm() > 0)) {
      throw base::InputError({.value = fmt::format("a mesh wall's triangle {} has no area", k),
                              .fix = "remove degenerate triangles from the file."});
    }
  }
}

}  // namespace

MeshFacets::MeshFacets(const Mesh& mesh) : mesh_(with_shared_corners(mesh)), tree_(mesh_) {
  check(mesh_);
  corner_start_.assign(mesh_.vertices.size() + 1, 0);
  for (const auto& triangle : mesh_.triangles) {
    for (const int corner : triangle) ++corner_start_[static_cast<std::size_t>(corner) + 1];
  }
  for (std::size_t k = 1; k < corner_start_.size(); ++k) corner_start_[k] += corner_start_[k - 1];
  corner_triangles_.resize(3 * mesh_.triangles.size());
  std::vector<int> next(corner_start_.begin(), corner_start_.end() - 1);
  for (std::size_t k = 0; k < mesh_.triangles.size(); ++k) {
    for (const int corner : mesh_.triangles[k]) {
      const int at = next[static_cast<std::size_t>(corner)]++;
      corner_triangles_[static_cast<std::size_t>(at)] = static_cast<int>(k);
    }
  }
}

void MeshFacets::near(const Vector& point, double distance, std::vector<int>& facets) const {
  facets.clear();
  const Vector half = Vector::Constant(distance);
  tree_.append_touching(Bounds(point - half, point + half), facets);
  std::sort(facets.begin(), facets.end());
}

TrianglePoint MeshFacets::nearest(int facet, const Vector& point) const {
  const auto& [a, b, c] = mesh_.triangles[static_cast<std::size_t>(facet)];
  const auto at = [this](int corner) -> const Vector& {
    return mesh_.vertices[static_cast<std::size_t>(corner)];
  };
  return nearest_on_triangle(point, at(a), at(b), at(c));
}

Closest MeshFacets::closest(int facet, const Vector& point) const {
  const TrianglePoint spot = nearest(facet, point);
  const Vector away = point - spot.point;
  const double distance = away.norm();
  if (distance == 0 || !owns(facet, spot, point)) {
    return {.distance = kEndless, .normal = Vector::UnitZ()};
  }
  return {.distance = distance, .normal = away / distance};
}

bool MeshFacets::owns(int facet, const TrianglePoint& spot, const Vector& point) const {
  using Part = TrianglePoint::Part;
  if (spot.part == Part::face) return true;
  const auto& corners = mesh_.triangles[static_cast<std::size_t>(facet)];
  const int from = corners[static_cast<std::size_t>(spot.index)];
  const int to = corners[static_cast<std::size_t>((spot.index + 1) % 3)];
  const auto begin = static_cast<std::size_t>(corner_start_[static_cast<std::size_t>(from)]);
  const auto end = static_cast<std::size_t>(corner_start_[static_cast<std::size_t>(from) + 1]);
  for (std::size_t k = begin; k < end; ++k) {
    const int other = corner_triangles_[k];
    if (other == facet) continue;
    const auto& others = mesh_.triangles[static_cast<std::size_t>(other)];
    if (spot.part == Part::edge && std::find(others.begin(), others.end(), to) == others.end()) {
      continue;  // it shares a corner of the edge only
    }
    const TrianglePoint near = nearest(other, point);
    const double there = (point - near.point).squaredNorm();
    const double here = (point - spot.point).squaredNorm();
    // The shared edge is part of `other`, which cannot be farther away except by rounding.
    const bool is_same_spot = near.part != Part::face && there >= here * (1 - 1e-12);
    if (!is_same_spot || other < facet) return false;
  }
  return true;
}

}  // namespace repose::dem
