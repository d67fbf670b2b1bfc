#pragma once

#include <string>
#include <vector>

#include "calibrate/export/export.h"
#include "calibrate/export/facts.h"

/// Common parts of the LIGGGHTS decks; each deck is a filled-in file of templates/liggghts.

namespace repose::calibrate {

/// The rolling-friction keywords that follow a contact model: " rolling_friction epsd".
std::string liggghts_rolling_words(dem::RollingModel model);

/// coefficientRollingViscousDamping of epsd, as in our own elastic_plastic (dem/THEORY.md).
inline constexpr double kLiggghtsRollingDamping = .3;

/// The number of a part's material; the plate's, 2, if it has none of its own.
int liggghts_type(const ExportFacts& facts, dem::WallPart part);

/// Fields used by all decks: stiffness, time step, the grain's bounding radius, types of parts.
DeckFields deck_fields(const ExportFacts& facts, dem::Experiment experiment);

/// Marks which sections apply to spheres and which to clumps.
void mark_shape(bool is_sphere, DeckFields& fields);

/// The density with which LIGGGHTS gives a sphere its mass; a clump has its own mass.
double density_kg_m3(const ExportFacts& facts, bool is_sphere);

/// Spheres of a body, one line each: x, y, z, radius.
std::string spheres_text(const dem::ClumpShape& shape);

/// The file that inserts one body: a sphere, or the clump that a deck names.
ExportedFile place_file(const ExportFacts& facts, const char* name, bool is_sphere);

/// Grains dropped one after the other.
struct DropDeck {
  dem::Experiment experiment = nullptr;
  std::string ground;   ///< what they fall on, as text
  std::string section;  ///< of the template that makes it
  double height_m = 0;
  std::vector<TouchingPose> poses;
};
ExportedFile drop_file(const ExportFacts& facts, const DropDeck& deck);

/// Decks of grain pairs, if the study has that experiment, and the files they read.
std::vector<ExportedFile> liggghts_files_of_pairs(const ExportFacts& facts);
/// Of grains poured into a vessel; heaps have their own deck.
std::vector<ExportedFile> liggghts_files_of_poured_grains(const ExportFacts& facts);
/// Of grains on a board of glued grains.
std::vector<ExportedFile> liggghts_files_on_grains(const ExportFacts& facts);

}  // namespace repose::calibrate
