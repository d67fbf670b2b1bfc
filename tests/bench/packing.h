#pragma once

#include "dem/engine/simulation.h"

namespace repose::testing {

/// The hazelnut of the samples as `spheres` spheres along the long axis of a spheroid, or as one
/// sphere of its volume.
dem::ClumpShape spheroid_nut(int spheres);

/// Grains that were poured into a container and came to rest. Softened (E / 100), with the
/// coefficients of the hazelnut sample.
///
/// @param threads  for the runs afterwards; the packing is the same for any number
dem::Simulation tube_of_clumps(int grains, int threads);
dem::Simulation box_of_spheres(int grains, int threads);

}  // namespace repose::testing
