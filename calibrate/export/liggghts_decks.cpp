#include "calibrate/export/liggghts_decks.h"

#include <algorithm>

#include <fmt/format.h>

#include "dem/study/experiment_table.h"

namespace repose::calibrate {

double density_kg_m3(const ExportFacts& facts, bool is_sphere) {
  return is_sphere ? facts.ball_density_kg_m3() : facts.study().model.grain_material.density_kg_m3;
}

std::string spheres_text(const dem::ClumpShape& shape) {
  std::string text;
  for (const dem::ClumpSphere& sphere : shape.spheres) {
    const dem::Vector& at = sphere.centre;
    text += fmt::format("{} {} {} {}\n", at.x(), at.y(), at.z(), sphere.radius);
  }
  return text;
}

ExportedFile place_file(const ExportFacts& facts, const char* name, bool is_sphere) {
  DeckFields fields = common_fields(facts);
  mark_shape(is_sphere, fields);
  fields.set("DIAMETER", 2 * facts.grain().spheres.front().radius);
  fields.set("DENSITY", density_kg_m3(facts, is_sphere));
  return {.name = name, .text = filled("liggghts/place.lig", fields)};
}

void mark_shape(bool is_sphere, DeckFields& fields) {
  fields.add_section(is_sphere ? "SPHERE" : "CLUMP");
}

int liggghts_type(const ExportFacts& facts, dem::WallPart part) {
  constexpr int kWallType = 2;
  const std::vector<dem::WallPart> parts = facts.parts();
  const auto found = std::ranges::find(parts, part);
  if (found == parts.end()) return kWallType;
  return kWallType + 1 + static_cast<int>(found - parts.begin());
}

DeckFields deck_fields(const ExportFacts& facts, dem::Experiment experiment) {
  DeckFields fields = common_fields(facts);
  fields.set("STIFFNESS", facts.stiffness(experiment));
  fields.set("TIMESTEP", facts.timestep_s(experiment));
  fields.set("REACH", 2 * facts.grain().reach_m());
  fields.set("TUBE_TYPE", liggghts_type(facts, dem::WallPart::tube));
  fields.set("INCLINE_TYPE", liggghts_type(facts, dem::WallPart::incline));
  fields.set("PANE_TYPE", liggghts_type(facts, dem::WallPart::pane));
  return fields;
}

ExportedFile drop_file(const ExportFacts& facts, const DropDeck& deck) {
  const std::string name = name_of(deck.experiment);
  const double timestep = facts.timestep_s(deck.experiment);
  double top = 0;
  for (const TouchingPose& pose : deck.poses) top = std::max(top, pose.height_m);
  DeckFields fields = deck_fields(facts, deck.experiment);
  set_body(facts.grain(), facts.study().model.grain_material.density_kg_m3, fields);
  fields.add_section(deck.section);
  fields.set("NAME", name);
  fields.set("GROUND", deck.ground);
  fields.set("HEIGHT_MM", 1e3 * deck.height_m);
  fields.set("GRAINS", static_cast<int>(deck.poses.size()));
  fields.set("SPEED", facts.speed_m_s(deck.experiment));
  fields.set("ROOM", deck.height_m + 10 * facts.grain().reach_m());
  fields.set("TOP", deck.height_m + top + 10 * facts.grain().reach_m());
  fields.set("STEPS", steps(facts.longest_drop_s(deck.experiment), timestep));
  fields.set("EVERY", 5);
  int number = 0;
  for (const TouchingPose& pose : deck.poses) {
    DeckFields& own = fields.add_section("POSE");
    own.set("NUMBER", ++number);
    own.set("HEIGHT", pose.height_m);
    set_pose(pose.orientation, own);
  }
  return {.name = name + ".lig", .text = filled("liggghts/drop.lig", fields)};
}

}  // namespace repose::calibrate
