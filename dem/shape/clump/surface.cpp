#include "dem/shape/clump/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {

namespace {

double angle_between(const Vector& a, const Vector& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

SurfaceDistance::SurfaceDistance(const Mesh& mesh)
    : mesh_(mesh),
      tree_(mesh),
      corner_normals_(mesh.vertices.size(), Vector::Zero()),
      edge_normals_(mesh.triangles.size()) {
  face_normals_.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    const Vector normal = area_normal(mesh, triangle).stableNormalized();
    face_normals_.push_back(normal);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector& here = corner(mesh, triangle, i);
      const double angle = angle_between(corner(mesh, triangle, (i + 1) % 3) - here,
                                         corner(mesh, triangle, (i + 2) % 3) - here);
      corner_normals_[static_cast<std::size_t>(triangle[i])] += angle * normal;
    }
  }
  const std::vector<EdgeUse> uses = edge_uses(mesh);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    Vector sum = Vector::Zero();
    for (const EdgeUse& use : edge) sum += face_normals_[static_cast<std::size_t>(use.triangle)];
    for (const EdgeUse& use : edge) {
      edge_normals_[static_cast<std::size_t>(use.triangle)][static_cast<std::size_t>(use.side)] =
          sum;
    }
  });
}

Vector SurfaceDistance::normal_at(const TriangleTree::Nearest& nearest) const {
  const auto triangle = static_cast<std::size_t>(nearest.triangle);
  const auto index = static_cast<std::size_t>(nearest.where.index);
  switch (nearest.where.part) {
    case TrianglePoint::Part::corner:
      return corner_normals_[static_cast<std::size_t>(mesh_.triangles[triangle][index])];
    case TrianglePoint::Part::edge:
      return edge_normals_[triangle][index];
    case TrianglePoint::Part::face:
      break;
  }
  return face_normals_[triangle];
}

double SurfaceDistance::signed_distance(const Vector& point) const {
  const TriangleTree::Nearest nearest = tree_.nearest(point);
  const double distance = std::sqrt(nearest.squared_distance);
  return normal_at(nearest).dot(point - nearest.where.point) < 0 ? -distance : distance;
}

namespace {

/// Point k of a sequence that fills the unit square evenly.
/// Source: Roberts, The unreasonable effectiveness of quasirandom sequences (2018): additive
/// recurrence with the powers of 1/p, p^3 = p + 1.
struct SquarePoint {
  double u, v;
};
SquarePoint square_point(std::size_t k) {
  constexpr double kPlastic = 1.324717957244746;
  const double n = static_cast<double>(k) + 1;
  const double u = 0.5 + n / kPlastic, v = 0.5 + n / (kPlastic * kPlastic);
  return {u - std::floor(u), v - std::floor(v)};
}

/// Point k of n spread evenly over the unit sphere, on a spiral.
/// Source: Swinbank & Purser, Fibonacci grids, Q. J. R. Meteorol. Soc. 132 (2006) 1769-1793.
Vector sphere_point(std::size_t k, std::size_t n) {
  const double z = (2 * static_cast<double>(k) + 1) / static_cast<double>(n) - 1;
  const double angle = 2 * std::numbers::pi * static_cast<double>(k) * (1 - 1 / std::numbers::phi);
  const double across = std::sqrt((1 - z) * (1 + z));
  return {across * std::cos(angle), across * std::sin(angle), z};
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const Mesh& mesh, std::size_t count) {
  const double step = area_m2(mesh) / static_cast<double>(count);
  std::vector<SurfaceSample> samples;
  samples.reserve(count);
  double passed = 0;
  for (const auto& triangle : mesh.triangles) {
    const Vector normal = area_normal(mesh, triangle);
    passed += normal.norm() / 2;
    while (samples.size() < count && (static_cast<double>(samples.size()) + 0.5) * step <= passed) {
      const SquarePoint at = square_point(samples.size());
      const bool is_folded = at.u + at.v > 1;
      const double u = is_folded ? 1 - at.u : at.u, v = is_folded ? 1 - at.v : at.v;
      const Vector& a = corner(mesh, triangle, 0);
      samples.push_back(
          {.point = a + u * (corner(mesh, triangle, 1) - a) + v * (corner(mesh, triangle, 2) - a),
           .normal = normal.stableNormalized()});
    }
  }
  return samples;
}

std::vector<WeightedPoint> sample_union(std::span<const ClumpSphere> spheres, std::size_t count) {
  double squares = 0;
  for (const ClumpSphere& sphere : spheres) squares += sphere.radius * sphere.radius;
  std::vector<WeightedPoint> points;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const ClumpSphere& sphere = spheres[i];
    const double square = sphere.radius * sphere.radius;
    const auto own =
        static_cast<std::size_t>(std::ceil(static_cast<double>(count) * (square / squares)));
    for (std::size_t k = 0; k < own; ++k) {
      const Vector point = sphere.centre + sphere.radius * sphere_point(k, own);
      bool is_hidden = false;
      for (std::size_t j = 0; j < spheres.size() && !is_hidden; ++j) {
        is_hidden = j != i && (point - spheres[j].centre).squaredNorm() <
                                  spheres[j].radius * spheres[j].radius;
      }
      if (is_hidden) continue;
      points.push_back({point, 4 * std::numbers::pi * square / static_cast<double>(own)});
    }
  }
  return points;
}

namespace {

/// Whether the point is left of the line from corner `i` to corner `j`, seen along z: consistent
/// for both triangles at an edge. A point on the line counts as shifted slightly to higher x, and
/// by much less to higher y.
bool is_left_of(const Mesh& mesh, int i, int j, double x, double y) {
  const bool is_swapped = i > j;
  const Vector& p = mesh.vertices[static_cast<std::size_t>(is_swapped ? j : i)];
  const Vector& q = mesh.vertices[static_cast<std::size_t>(is_swapped ? i : j)];
  const double side = (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x());
  bool is_left = side > 0;
  if (side == 0) is_left = q.y() != p.y() ? q.y() < p.y() : q.x() > p.x();
  return is_left != is_swapped;
}

bool is_over(const Mesh& mesh, const std::array<int, 3>& triangle, double x, double y) {
  const bool left = is_left_of(mesh, triangle[0], triangle[1], x, y);
  return is_left_of(mesh, triangle[1], triangle[2], x, y) == left &&
         is_left_of(mesh, triangle[2], triangle[0], x, y) == left;
}

double height_at(const Mesh& mesh, const std::array<int, 3>& triangle, double x, double y) {
  const Vector normal = area_normal(mesh, triangle);
  const Vector& a = corner(mesh, triangle, 0);
  if (normal.z() == 0) return a.z();  // vertical, hit only by rounding
  return a.z() - (normal.x() * (x - a.x()) + normal.y() * (y - a.y())) / normal.z();
}

double overlap(const Chords& a, const Chords& b) {
  double sum = 0;
  for (const Chord& one : a) {
    for (const Chord& other : b) {
      sum += std::max(0.0, std::min(one.to, other.to) - std::max(one.from, other.from));
    }
  }
  return sum;
}

double length(const Chords& chords) {
  double sum = 0;
  for (const Chord& chord : chords) sum += chord.to - chord.from;
  return sum;
}

void merge(Chords& chords) {
  std::sort(chords.begin(), chords.end(),
            [](const Chord& a, const Chord& b) { return a.from < b.from; });
  Chords merged;
  for (const Chord& chord : chords) {
    if (!merged.empty() && chord.from <= merged.back().to) {
      merged.back().to = std::max(merged.back().to, chord.to);
    } else {
      merged.push_back(chord);
    }
  }
  chords = std::move(merged);
}

}  // namespace

ColumnGrid::ColumnGrid(const Eigen::AlignedBox3d& bounds, int across)
    : low_(bounds.min()), spacing_(bounds.sizes().head<2>().maxCoeff() / across) {
  columns_x_ = std::max(1, static_cast<int>(std::ceil(bounds.sizes().x() / spacing_)));
  columns_y_ = std::max(1, static_cast<int>(std::ceil(bounds.sizes().y() / spacing_)));
}

ColumnGrid::Place ColumnGrid::place(std::size_t column) const {
  const auto across = static_cast<std::size_t>(columns_x_);
  const auto row = static_cast<int>(column / across), i = static_cast<int>(column % across);
  return {low_.x() + (i + 0.5) * spacing_, low_.y() + (row + 0.5) * spacing_};
}

ColumnGrid::Range ColumnGrid::range(double from, double to, double low, int count) const {
  const auto first = static_cast<int>(std::floor((from - low) / spacing_ - 0.5));
  const auto last = static_cast<int>(std::ceil((to - low) / spacing_ - 0.5));
  return {std::max(0, first), std::min(count - 1, last)};
}

std::vector<Chords> ColumnGrid::of_surface(const Mesh& mesh) const {
  std::vector<std::vector<double>> heights(size());
  for (const auto& triangle : mesh.triangles) {
    Eigen::AlignedBox3d bounds(corner(mesh, triangle, 0));
    bounds.extend(corner(mesh, triangle, 1));
    bounds.extend(corner(mesh, triangle, 2));
    const Range xs = range(bounds.min().x(), bounds.max().x(), low_.x(), columns_x_);
    const Range ys = range(bounds.min().y(), bounds.max().y(), low_.y(), columns_y_);
    for (int row = ys.from; row <= ys.to; ++row) {
      for (int i = xs.from; i <= xs.to; ++i) {
        const auto column = index(row, i);
        const Place at = place(column);
        if (!is_over(mesh, triangle, at.x, at.y)) continue;
        const double height = height_at(mesh, triangle, at.x, at.y);
        heights[column].push_back(std::clamp(height, bounds.min().z(), bounds.max().z()));
      }
    }
  }
  std::vector<Chords> columns(size());
  for (std::size_t column = 0; column < columns.size(); ++column) {
    std::vector<double>& crossings = heights[column];
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      columns[column].push_back({crossings[i], crossings[i + 1]});
    }
  }
  return columns;
}

std::vector<Chords> ColumnGrid::of_union(std::span<const ClumpSphere> spheres) const {
  std::vector<Chords> columns(size());
  for (const ClumpSphere& sphere : spheres) {
    const Vector& centre = sphere.centre;
    const Range xs =
        range(centre.x() - sphere.radius, centre.x() + sphere.radius, low_.x(), columns_x_);
    const Range ys =
        range(centre.y() - sphere.radius, centre.y() + sphere.radius, low_.y(), columns_y_);
    for (int row = ys.from; row <= ys.to; ++row) {
      for (int i = xs.from; i <= xs.to; ++i) {
        const auto column = index(row, i);
        const Place at = place(column);
        const double dx = at.x - centre.x(), dy = at.y - centre.y();
        const double square = sphere.radius * sphere.radius - dx * dx - dy * dy;
        if (square <= 0) continue;
        const double half = std::sqrt(square);
        columns[column].push_back({centre.z() - half, centre.z() + half});
      }
    }
  }
  for (Chords& chords : columns) merge(chords);
  return columns;
}

MassProperties ColumnGrid::mass_properties(const std::vector<Chords>& columns) const {
  double volume = 0;
  Vector first = Vector::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  const double area = spacing_ * spacing_;
  for (std::size_t column = 0; column < columns.size(); ++column) {
    const Place at = place(column);
    for (const Chord& chord : columns[column]) {
      const double part = area * (chord.to - chord.from);
      const double z = (chord.from + chord.to) / 2, half = (chord.to - chord.from) / 2;
      const Vector middle(at.x, at.y, z);
      volume += part;
      first += part * middle;
      second += part * middle * middle.transpose();
      second(2, 2) += part * half * half / 3;
      second(0, 0) += part * area / 12;
      second(1, 1) += part * area / 12;
    }
  }
  if (volume <= 0) return {};
  const Vector centroid = first / volume;
  return {.volume_m3 = volume,
          .centroid = centroid,
          .second_moment_m2 = second / volume - centroid * centroid.transpose()};
}

double ColumnGrid::mismatch_m3(const std::vector<Chords>& a, const std::vector<Chords>& b) const {
  double sum = 0;
  for (std::size_t column = 0; column < a.size(); ++column) {
    sum += length(a[column]) + length(b[column]) - 2 * overlap(a[column], b[column]);
  }
  return sum * spacing_ * spacing_;
}

std::vector<Vector> ColumnGrid::points_inside(const std::vector<Chords>& columns) const {
  std::vector<Vector> points;
  for (std::size_t column = 0; column < columns.size(); ++column) {
    const Place at = place(column);
    for (const Chord& chord : columns[column]) {
      const double first = std::ceil((chord.from - low_.z()) / spacing_ - 0.5);
      for (double k = first; low_.z() + (k + 0.5) * spacing_ < chord.to; ++k) {
        points.emplace_back(at.x, at.y, low_.z() + (k + 0.5) * spacing_);
      }
    }
  }
  return points;
}

}  // namespace repose::dem
