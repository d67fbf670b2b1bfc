#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/StdVector>

#include "dem/engine/bodies.h"
#include "dem/engine/neighbour_list.h"
#include "dem/wall/wall_set.h"

namespace repose::dem {

/// A body's three ways to move and three to turn.
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrices = std::vector<Matrix6, Eigen::aligned_allocator<Matrix6>>;

/// Of any of these matrices, symmetric and with no negative eigenvalue; 0 of none.
double greatest_eigenvalue(const Matrices& matrices);

/// Highest angular frequency that the touching contacts can make bodies swing with, rad/s; none
/// without contacts.
///
/// A bound, never too low: omega^2 <= max over bodies of c lambda_max(M^-1/2 K M^-1/2), K the 6 x 6
/// stiffness of all the body's contacts (normal and tangential), M its mass and inertia; c = 1 for
/// contacts with walls, 2 between bodies (for each contact (x + y)^2 <= 2 x^2 + 2 y^2; the
/// element-by-element bound of Fried 1972, for rigid bodies). A leapfrog step is stable below
/// 2 / omega. Proved by StableTimestep.* in tests/dem/timestep_test.cpp.
std::optional<double> highest_frequency(const Bodies& bodies, const WallSet& walls,
                                        const ContactTable& contacts, const NeighbourList& list);

Energies energies_of(const Bodies& bodies, const WallSet& walls, const ContactTable& contacts,
                     const NeighbourList& list, const Vector& gravity);

/// The body, the first one of two, of the deepest overlap, as a fraction of the smaller sphere's
/// radius.
int deepest_body(const Bodies& bodies, const WallSet& walls, const ContactTable& contacts,
                 const NeighbourList& list);

}  // namespace repose::dem
