#pragma once

#include <cstddef>
#include <vector>

#include "dem/shape/clump/clump_shape.h"
#include "dem/shape/clump/sphere_fit.h"
#include "dem/shape/clump/surface_samples.h"

namespace repose::dem {

/// Fits `count` spheres to the surface, starting with those given, then gets them out of local
/// minima: a sphere that the fit can spare is put where the error is largest and all are fitted
/// again; what is better stays. Ends when no such move helps, or after a number of attempts that
/// depends on the number of spheres alone.
void relocate_and_fit(const SphereFit& fit, const std::vector<SurfaceSample>& samples,
                      std::size_t count, std::vector<ClumpSphere>& spheres);

}  // namespace repose::dem
