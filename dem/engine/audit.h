#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/StdVector>

#include "dem/engine/bodies.h"
#include "dem/engine/neighbour_list.h"
#include "dem/wall/wall_set.h"

namespace repose::dem {

/// A body's three translations and three rotations.
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrices = std::vector<Matrix6, Eigen::aligned_allocator<Matrix6>>;

/// The greatest eigenvalue of any of these symmetric, positive semi-definite matrices; 0 if empty.
double greatest_eigenvalue(const Matrices& matrices);

/// Highest angular frequency at which the active contacts can make bodies oscillate, rad/s;
/// std::nullopt without contacts.
///
/// An upper bound, never too low: omega^2 <= max over bodies of c lambda_max(M^-1/2 K M^-1/2), K
/// the 6 x 6 stiffness of all the body's contacts (normal and tangential), M its mass and inertia;
/// c = 1 for contacts with walls, 2 between bodies (for each contact (x + y)^2 <= 2 x^2 + 2 y^2;
/// the element-by-element bound of Fried 1972, for rigid bodies). A leapfrog step is stable below
/// 2 / omega. Proved by StableTimestep.* in tests/dem/timestep_test.cpp.
std::optional<double> highest_frequency(const Bodies& bodies, const WallSet& walls,
                                        const ContactTable& contacts, const NeighbourList& list);

Energies energies_of(const Bodies& bodies, const WallSet& walls, const ContactTable& contacts,
                     const NeighbourList& list, const Vector& gravity);

/// The (first) body of the contact whose overlap is the largest fraction of the smaller sphere's
/// radius; -1 without contacts.
int deepest_body(const Bodies& bodies, const WallSet& walls, const ContactTable& contacts,
                 const NeighbourList& list);

}  // namespace repose::dem
