#pragma once

#include <vector>

#include "dem/shape/clump/clump_shape.h"
#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// Up to `count` spheres inside a watertight surface, each the one that adds most volume to those
/// before it. The classical way to fill a grain, which leaves its corners and tips empty: fill()
/// starts from it and improves on it.
/// Source: greedy cover with lazy evaluation, Minoux, Accelerated greedy algorithms for maximizing
/// submodular set functions (1978); candidates are centred on the points of a grid.
std::vector<ClumpSphere> inscribed_spheres(const Mesh& mesh, int count);

}  // namespace repose::dem
