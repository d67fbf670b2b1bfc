#pragma once

#include "dem/engine/simulation.h"
#include "dem/state/array_list.h"
#include "dem/state/vtk_file.h"

/// The dynamic state of a simulation as points and arrays, and back.
namespace repose::dem {

/// Grains that are present become points, the others arrays in the field data.
void add_checkpoint(const Checkpoint& checkpoint, const Simulation& simulation, VtkPoints& points,
                    ArrayWriter& fields);

/// `setup` defines the kinds and walls.
/// @throws base::InputError  naming the array that is missing or does not fit.
Checkpoint checkpoint_in(const VtkPoints& points, const SimulationSetup& setup);

}  // namespace repose::dem
