#pragma once

#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// `count` grains that touch, all turned the same way, as one rigid grain.
///
/// They stand in a row along their middle axis: in lying_pose() the row lies along x. Mass and
/// inertia are those of the grains' own surfaces, by the parallel axis theorem (Goldstein, Poole,
/// Safko 2002, Classical Mechanics, sec. 5.3): a row along one principal axis keeps the axes, and
/// adds the mean square distance from its middle to the other two. Proved by Bonded.* in
/// tests/dem/experiment_bonded_test.cpp. The surface is left empty.
ClumpShape bonded_shape(const ClumpShape& grain, int count);

}  // namespace repose::dem
