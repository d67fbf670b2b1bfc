#pragma once

#include <vector>

#include "calibrate/export/export.h"
#include "calibrate/export/facts.h"

/// What the decks of LIGGGHTS share; each is a file of templates/liggghts filled in.
namespace repose::calibrate {

/// What all decks name: stiffness, time step, the reach of the grain.
DeckFields deck_fields(const ExportFacts& facts, dem::Experiment experiment);

/// Marks what is there for spheres, and what for clumps.
void mark_shape(bool is_sphere, DeckFields& fields);

/// Decks of the experiments between grains that the study has, and what these read.
std::vector<ExportedFile> liggghts_files_between_grains(const ExportFacts& facts);

}  // namespace repose::calibrate
