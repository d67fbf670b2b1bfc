#include "dem/shape/scan/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "base/input_error.h"

namespace repose::dem {

std::vector<EdgeUse> edge_uses(const Mesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t side = 0; side < 3; ++side) {
      const int from = mesh.triangles[t][side], to = mesh.triangles[t][(side + 1) % 3];
      uses.push_back({.low = std::min(from, to),
                      .high = std::max(from, to),
                      .triangle = static_cast<int>(t),
                      .side = static_cast<int>(side),
                      .is_upward = from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.triangle, a.side) <
           std::tie(b.low, b.high, b.triangle, b.side);
  });
  return uses;
}

bool is_watertight(const Mesh& mesh) {
  bool is_tight = !mesh.triangles.empty();
  for_each_edge(edge_uses(mesh), [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2 || edge[0].is_upward == edge[1].is_upward) is_tight = false;
  });
  return is_tight;
}

namespace {

constexpr double kEqualFraction = 1e-6;      // of moments of inertia
constexpr double kSymmetricFraction = 1e-6;  // of |x^3|'s scale

/// Mean of x^3 along each axis, over the body. In a tetrahedron with one corner at the centroid,
/// int x^3 = det/120 times the sum of all products of degree 3 of the other corners' x. Source: as
/// mass_properties; the moment of degree n of a simplex. Proved by
/// PrincipalFrame.SeesTheSameBodyHoweverTheScanLies.
Vector third_moments(const Mesh& mesh, const MassProperties& body, const Eigen::Matrix3d& axes) {
  Vector sum = Vector::Zero();
  for (const auto& triangle : mesh.triangles) {
    const Vector to_a = corner(mesh, triangle, 0) - body.centroid,
                 to_b = corner(mesh, triangle, 1) - body.centroid,
                 to_c = corner(mesh, triangle, 2) - body.centroid;
    const double det = to_a.dot(to_b.cross(to_c));  // in the scan's frame: the axes may be mirrored
    const Vector a = axes.transpose() * to_a, b = axes.transpose() * to_b,
                 c = axes.transpose() * to_c;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double x = a[i], y = b[i], z = c[i];
      sum[i] += det / 120 *
                (x * x * x + y * y * y + z * z * z + x * x * y + x * x * z + y * y * x + y * y * z +
                 z * z * x + z * z * y + x * y * z);
    }
  }
  return sum / body.volume_m3;
}

/// The unit axis of the scan's frame closest to perpendicular to `axis`, made perpendicular.
Vector perpendicular_to(const Vector& axis) {
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const Vector scan_axis = Vector::Unit(least);
  return (scan_axis - scan_axis.dot(axis) * axis).normalized();
}

/// Directions within a plane or space of equal moments are determined only by rounding: choose
/// them.
void settle_equal_moments(const Vector& moments, Eigen::Matrix3d& axes) {
  const double equal = kEqualFraction * moments[2];
  const bool low_pair = moments[1] - moments[0] <= equal;
  const bool high_pair = moments[2] - moments[1] <= equal;
  if (low_pair && high_pair) {
    axes.setIdentity();
  } else if (high_pair) {
    axes.col(1) = perpendicular_to(axes.col(0));
  } else if (low_pair) {
    axes.col(0) = perpendicular_to(axes.col(2));
    axes.col(1) = axes.col(2).cross(axes.col(0));
  }
}

void settle_signs(const Mesh& mesh, const MassProperties& body, Eigen::Matrix3d& axes) {
  const Vector thirds = third_moments(mesh, body, axes);
  const double scale = std::pow(body.second_moment_m2.trace(), 1.5);
  for (Eigen::Index i = 0; i < 2; ++i) {
    Eigen::Index largest = 0;
    axes.col(i).cwiseAbs().maxCoeff(&largest);
    const bool is_symmetric = std::abs(thirds[i]) <= kSymmetricFraction * scale;
    const double direction = is_symmetric ? axes(largest, i) : thirds[i];
    if (direction < 0) axes.col(i) = -axes.col(i);
  }
  axes.col(2) = axes.col(0).cross(axes.col(1));
}

}  // namespace

MassProperties mass_properties(const Mesh& mesh) {
  if (mesh.triangles.empty()) {
    throw base::InputError(
        {.where = "surface", .value = "holds no triangles", .fix = "give a closed surface."});
  }
  const Vector point =
      bounds_of(mesh).center();  // near the body, as precision would be lost far away
  double volume = 0;
  Vector first = Vector::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (const auto& triangle : mesh.triangles) {
    const Vector a = corner(mesh, triangle, 0) - point, b = corner(mesh, triangle, 1) - point,
                 c = corner(mesh, triangle, 2) - point;
    const Vector s = a + b + c;
    const double det = a.dot(b.cross(c));
    volume += det / 6;
    first += det / 24 * s;
    second +=
        det / 120 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  }
  if (!(volume > 0)) {
    throw base::InputError(
        {.where = "surface",
         .value = "encloses no volume, or is inside out",
         .fix = "give a closed surface whose triangles run counter-clockwise seen from outside."});
  }
  const Vector shift = first / volume;
  return {.volume_m3 = volume,
          .centroid = point + shift,
          .second_moment_m2 = second / volume - shift * shift.transpose()};
}

Eigen::Matrix3d gyration_of(const Eigen::Matrix3d& second_moment_m2) {
  return second_moment_m2.trace() * Eigen::Matrix3d::Identity() - second_moment_m2;
}

PrincipalFrame principal_frame(const Mesh& mesh) {
  const MassProperties body = mass_properties(mesh);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(gyration_of(body.second_moment_m2));
  PrincipalFrame frame{
      .origin = body.centroid, .axes = solver.eigenvectors(), .gyration_m2 = solver.eigenvalues()};
  settle_equal_moments(frame.gyration_m2, frame.axes);
  settle_signs(mesh, body, frame.axes);
  return frame;
}

Mesh in_frame(const Mesh& mesh, const PrincipalFrame& frame) {
  Mesh moved = mesh;
  for (Vector& vertex : moved.vertices) {
    vertex = frame.axes.transpose() * (vertex - frame.origin);
  }
  return moved;
}

}  // namespace repose::dem
