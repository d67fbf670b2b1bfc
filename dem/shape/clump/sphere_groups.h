#pragma once

#include <vector>

#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// How many groups the spheres fall into that do not touch each other. More than one is no grain:
/// others could pass through the gap.
int sphere_groups(const std::vector<ClumpSphere>& spheres);

}  // namespace repose::dem
