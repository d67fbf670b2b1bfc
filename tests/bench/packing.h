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
dem::Simulation box_of_clumps(int grains, int threads);

/// A box poured with a ninth of the grains and mirrored at its sides to 3 x 3, so that grains that
/// touched a side touch their image: at rest for a ninth of the pouring. `grains` is rounded up.
dem::Simulation wide_box_of_spheres(int grains, int threads);
dem::Simulation wide_box_of_clumps(int grains, int threads);

/// The empty tube of tube_of_clumps.
dem::SimulationSetup tube_setup(int threads);

}  // namespace repose::testing
