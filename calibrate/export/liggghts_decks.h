#pragma once

#include <string>
#include <vector>

#include "calibrate/export/export.h"
#include "calibrate/export/facts.h"

/// What the decks of LIGGGHTS share; each is a file of templates/liggghts filled in.

namespace repose::calibrate {

/// What follows a contact model, of rolling friction: " rolling_friction epsd".
std::string liggghts_rolling_words(dem::RollingModel model);

/// coefficientRollingViscousDamping of epsd, as our own elastic_plastic has it (dem/THEORY.md).
inline constexpr double kLiggghtsRollingDamping = .3;

/// The number of a part's material: the plate's, 2, where it has none of its own.
int liggghts_type(const ExportFacts& facts, dem::WallPart part);

/// What all decks name: stiffness, time step, the reach of the grain, types of parts.
DeckFields deck_fields(const ExportFacts& facts, dem::Experiment experiment);

/// Marks what is there for spheres, and what for clumps.
void mark_shape(bool is_sphere, DeckFields& fields);

/// With which LIGGGHTS gives a sphere its mass; a clump has a mass of its own.
double density_kg_m3(const ExportFacts& facts, bool is_sphere);

/// Spheres of a body, a line each: x, y, z, radius.
std::string spheres_text(const dem::ClumpShape& shape);

/// What puts one body in: a sphere, or the clump that a deck names.
ExportedFile place_file(const ExportFacts& facts, const char* name, bool is_sphere);

/// Grains that fall, one after the other.
struct DropDeck {
  dem::Experiment experiment = nullptr;
  std::string ground;   ///< what they fall on, for people
  std::string section;  ///< of the template that makes it
  double height_m = 0;
  std::vector<TouchingPose> poses;
};
ExportedFile drop_file(const ExportFacts& facts, const DropDeck& deck);

/// Decks of pairs of grains, where the study has that experiment, and what these read.
std::vector<ExportedFile> liggghts_files_of_pairs(const ExportFacts& facts);
/// Of grains that are poured into a vessel; heaps have a deck of their own.
std::vector<ExportedFile> liggghts_files_of_poured_grains(const ExportFacts& facts);
/// And of grains on a board of glued ones.
std::vector<ExportedFile> liggghts_files_on_grains(const ExportFacts& facts);

}  // namespace repose::calibrate
