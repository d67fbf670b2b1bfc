#include "dem/engine/audit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace repose::dem {

double greatest_eigenvalue(const Matrices& matrices) {
  if (matrices.empty()) return 0;
  // No eigenvalue exceeds the norm: after the matrix of greatest norm few others need solving.
  const auto norm = [](const Matrix6& matrix) { return matrix.squaredNorm(); };
  const Matrix6& first = *std::ranges::max_element(matrices, {}, norm);
  double greatest = 0;
  const auto see = [&greatest](const Matrix6& matrix) {
    if (matrix.squaredNorm() <= greatest * greatest) return;
    const Eigen::SelfAdjointEigenSolver<Matrix6> solver(matrix, Eigen::EigenvaluesOnly);
    greatest = std::max(greatest, solver.eigenvalues()[5]);
  };
  see(first);
  for (const Matrix6& matrix : matrices) see(matrix);
  return greatest;
}

namespace {

int material_of(const Bodies& bodies, int body) {
  return bodies.material[static_cast<std::size_t>(body)];
}

struct AuditedTouch {
  int a = 0;
  int b = 0;  ///< -1: a wall
  const ContactLaw& law;
  Vector normal;  ///< unit, from a to b
  double overlap = 0;
  double reduced_radius = 0;
  double smaller_radius = 0;
  Vector point;
  const ContactHistory& memory;
};

/// Calls visit(AuditedTouch) for each contact.
template <typename Visit>
void for_each_touch(const Bodies& bodies, const WallSet& walls, const ContactTable& contacts,
                    const NeighbourList& list, const Visit& visit) {
  for (const NeighbourPair& pair : list.grains) {
    const ContactLaw& law = contacts.law(material_of(bodies, pair.a), material_of(bodies, pair.b));
    for (int k = pair.first; k < pair.first + pair.count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const PlacedSphere& a = bodies.spheres[static_cast<std::size_t>(list.spheres[at].a)];
      const PlacedSphere& b = bodies.spheres[static_cast<std::size_t>(list.spheres[at].b)];
      const Vector apart = b.centre - a.centre;
      const double overlap = a.radius + b.radius - apart.norm();
      if (overlap <= 0) continue;
      const Vector normal = apart.normalized();
      visit(AuditedTouch{pair.a, pair.b, law, normal, overlap,
                         a.radius * b.radius / (a.radius + b.radius), std::min(a.radius, b.radius),
                         a.centre + normal * (a.radius - overlap / 2), list.memories[at]});
    }
  }
  for (const NearWall& pair : list.walls) {
    const ContactLaw& law =
        contacts.law(material_of(bodies, pair.body), walls.wall(pair.wall).material);
    for (int k = pair.first; k < pair.first + pair.count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const PlacedSphere& a = bodies.spheres[static_cast<std::size_t>(list.facets[at].sphere)];
      const FacetContact facet = walls.contact(pair.wall, list.facets[at].facet, a.centre);
      const double overlap = a.radius - facet.distance;
      if (overlap <= 0) continue;
      const double curved = a.radius * facet.curvature;
      visit(AuditedTouch{pair.body, -1, law, -facet.normal, overlap, a.radius / (1 + curved),
                         a.radius / std::max(1.0, curved),
                         a.centre - facet.normal * (a.radius - overlap / 2),
                         list.wall_memories[at]});
    }
  }
}

Eigen::Matrix3d cross_matrix(const Vector& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

/// Adds a contact's stiffness to a body's, in coordinates scaled by the square roots of mass and
/// inertia.
void add_stiffness(const Bodies& bodies, std::size_t body, const Vector& point,
                   const Eigen::Matrix3d& stiffness, Matrix6& sum) {
  const Eigen::Matrix3d axes = bodies.orientation_of(body).toRotationMatrix();
  const Vector roots = bodies.inverse_inertia[body].cwiseSqrt();
  Eigen::Matrix<double, 3, 6> motion;  // of the point, per scaled coordinate
  motion.leftCols<3>() = Eigen::Matrix3d::Identity() / std::sqrt(bodies.mass[body]);
  motion.rightCols<3>() =
      -cross_matrix(point - bodies.position[body].xyz) * axes * roots.asDiagonal();
  sum += motion.transpose() * stiffness * motion;
}

}  // namespace

std::optional<double> highest_frequency(const Bodies& bodies, const WallSet& walls,
                                        const ContactTable& contacts, const NeighbourList& list) {
  Matrices sums(bodies.size(), Matrix6::Zero());
  bool any = false;
  for_each_touch(bodies, walls, contacts, list, [&](const AuditedTouch& touch) {
    const double radius = std::sqrt(touch.reduced_radius * touch.overlap);
    const double normal_stiffness = 2 * touch.law.reduced_young_pa * radius;
    const double tangential_stiffness =
        touch.law.sliding_friction > 0 ? 8 * touch.law.reduced_shear_pa * radius : 0;
    const Eigen::Matrix3d across = touch.normal * touch.normal.transpose();
    const Eigen::Matrix3d stiffness =
        normal_stiffness * across + tangential_stiffness * (Eigen::Matrix3d::Identity() - across);
    any = true;
    const auto ka = static_cast<std::size_t>(touch.a);
    if (touch.b < 0) {
      add_stiffness(bodies, ka, touch.point, stiffness, sums[ka]);
      return;
    }
    const auto kb = static_cast<std::size_t>(touch.b);
    add_stiffness(bodies, ka, touch.point, 2 * stiffness, sums[ka]);
    add_stiffness(bodies, kb, touch.point, 2 * stiffness, sums[kb]);
  });
  if (!any) return std::nullopt;
  return std::sqrt(greatest_eigenvalue(sums));
}

Energies energies_of(const Bodies& bodies, const WallSet& walls, const ContactTable& contacts,
                     const NeighbourList& list, const Vector& gravity) {
  Energies sum;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!bodies.is_present(k)) continue;
    const Eigen::Matrix3d axes = bodies.orientation_of(k).toRotationMatrix();
    const Vector own = axes.transpose() * bodies.angular_momentum[k];
    sum.kinetic_j += .5 * bodies.mass[k] * bodies.velocity[k].squaredNorm() +
                     .5 * own.cwiseAbs2().dot(bodies.inverse_inertia[k]);
    sum.potential_j -= bodies.mass[k] * gravity.dot(bodies.position[k].xyz);
  }
  for_each_touch(bodies, walls, contacts, list, [&sum](const AuditedTouch& touch) {
    const double radius = std::sqrt(touch.reduced_radius * touch.overlap);
    sum.elastic_j += 8.0 / 15 * touch.law.reduced_young_pa * radius * touch.overlap * touch.overlap;
    const double tangential_stiffness = 8 * touch.law.reduced_shear_pa * radius;
    sum.elastic_j += touch.memory.tangential.squaredNorm() / (2 * tangential_stiffness);
  });
  return sum;
}

int deepest_body(const Bodies& bodies, const WallSet& walls, const ContactTable& contacts,
                 const NeighbourList& list) {
  int body = -1;
  double deepest = 0;
  for_each_touch(bodies, walls, contacts, list, [&](const AuditedTouch& touch) {
    const double overlap = touch.overlap / touch.smaller_radius;
    if (overlap <= deepest) return;
    deepest = overlap;
    body = touch.a;
  });
  return body;
}

}  // namespace repose::dem
