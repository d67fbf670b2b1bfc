#pragma once

#include "dem/engine/simulation.h"
#include "dem/state/array_list.h"

/// A simulation's setup as named arrays, and back.

namespace repose::dem {

void add_setup(ArrayWriter& arrays, const SimulationSetup& setup);
/// @throws base::InputError  naming the array that is missing or does not fit.
SimulationSetup setup_in(const ArrayReader& arrays);

void add_walls(ArrayWriter& arrays, const std::vector<Wall>& walls);
std::vector<Wall> walls_in(const ArrayReader& arrays);

void add_kinds(ArrayWriter& arrays, const std::vector<GrainKind>& kinds);
std::vector<GrainKind> kinds_in(const ArrayReader& arrays);

/// Concatenated meshes: the numbers of corners and triangles of each, then the corners and
/// triangles.
void add_meshes(ArrayWriter& arrays, const std::string& name,
                const std::vector<const Mesh*>& meshes);
std::vector<Mesh> meshes_in(const ArrayReader& arrays, const std::string& name);

}  // namespace repose::dem
