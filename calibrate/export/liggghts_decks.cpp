#include "calibrate/export/liggghts_decks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "base/units.h"
#include "calibrate/export/stl.h"
#include "dem/experiment/draw_down.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/fill.h"
#include "dem/experiment/glued_bed.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/pendulum.h"
#include "dem/experiment/tilt.h"
#include "dem/experiment/tilt_on_grains.h"

namespace repose::calibrate {

std::string liggghts_rolling_words(dem::RollingModel model) {
  switch (model) {
    case dem::RollingModel::none:
      return "";
    case dem::RollingModel::elastic_plastic:
      return " rolling_friction epsd";
    case dem::RollingModel::constant_torque:
    case dem::RollingModel::relative_constant_torque:
      break;
  }
  return " rolling_friction cdt";
}

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
  // It may roll off the glued grains, but no faster than it arrived.
  const double farthest_m =
      facts.speed_m_s(deck.experiment) * facts.longest_drop_s(deck.experiment);
  fields.set("ROOM", farthest_m + 10 * facts.grain().reach_m());
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

namespace {

/// Distance around its drop point within which a grain may touch the bed, in its bounding radii.
constexpr double kAround = 8;
/// Time in which grains that fall into the hollows of a bed come to rest.
constexpr double kSettle_s = .5;

/// A square section of the periodic bed around a place, which becomes the origin.
std::vector<dem::ClumpSphere> bed_about(const dem::SphereBed& bed, const dem::Vector& place,
                                        double half_m) {
  std::vector<dem::ClumpSphere> near;
  for (const dem::FixedSphere& sphere : bed.spheres) {
    for (const int column : {-1, 0, 1}) {
      for (const int row : {-1, 0, 1}) {
        dem::Vector at = sphere.centre - place;
        at.x() += bed.tile * (column - std::round(at.x() / bed.tile));
        at.y() += bed.tile * (row - std::round(at.y() / bed.tile));
        if (std::abs(at.x()) > half_m || std::abs(at.y()) > half_m) continue;
        near.push_back({.centre = at, .radius = sphere.radius});
      }
    }
  }
  return near;
}

ExportedFile bed_file(const ExportFacts& facts, dem::Experiment experiment, int number,
                      const std::vector<dem::ClumpSphere>& spheres) {
  DeckFields fields = common_fields(facts);
  fields.set("DENSITY", facts.study().model.grain_material.density_kg_m3);
  int id = 0;
  for (const dem::ClumpSphere& sphere : spheres) {
    DeckFields& ball = fields.add_section("BALL");
    ball.set("ID", ++id);
    ball.set("X", sphere.centre.x());
    ball.set("Y", sphere.centre.y());
    ball.set("Z", sphere.centre.z());
    ball.set("D", 2 * sphere.radius);
  }
  return {.name = name_of(experiment) + "_bed_" + std::to_string(number) + ".lig",
          .text = filled("liggghts/bed.lig", fields)};
}

/// Random numbers are drawn in the same order as in our simulation with the study's first seed: the
/// same bed, poses and places.
std::vector<ExportedFile> drop_files(const ExportFacts& facts) {
  const dem::GrainDropProtocol& protocol = facts.study().protocol<dem::GrainDropProtocol>();
  const dem::ClumpShape& grain = facts.grain();
  dem::Random random(facts.study().seed);
  const dem::SphereBed bed = dem::glued_bed(grain, protocol.coverage, random);
  const double top = dem::top_m(bed);
  const double apart = dem::drop_spacing_m(protocol.height_m, grain.reach_m());
  DropDeck deck{.experiment = dem::experiment_of<dem::GrainDropProtocol>(),
                .ground = "a board covered with glued grains",
                .section = "BED",
                .height_m = protocol.height_m,
                .poses = {}};
  std::vector<ExportedFile> files;
  for (int k = 1; k <= protocol.grains; ++k) {
    const dem::Quaternion pose = random.orientation();
    const double x = random.between(0, bed.tile) + apart * (k - 1);
    const double y = random.between(0, bed.tile);
    const double height = top + dem::reach_towards(grain, pose, -dem::Vector::UnitZ());
    deck.poses.push_back({.orientation = pose, .height_m = height});
    files.push_back(
        bed_file(facts, deck.experiment, k, bed_about(bed, {x, y, 0}, kAround * grain.reach_m())));
  }
  files.push_back(drop_file(facts, deck));
  return files;
}

/// Bodies of grains on a tilting board.
struct TiltDeck {
  dem::Experiment experiment = dem::experiment_of<dem::GrainTiltProtocol>();
  int bonded = 1;
  double rate_deg_s = 0;
  int places = 1;
  double coverage = 0;
  std::string place_file;  ///< that inserts a body, and the spheres of one
  std::string body_file;
};

/// As in our simulation, see dem/experiment/tilt_on_grains.cpp.
ExportedFile tilt_on_grains_file(const ExportFacts& facts, const TiltDeck& deck,
                                 const dem::ClumpShape& body, double height_m) {
  constexpr double kLook_s = .002;
  constexpr double kStill = .01;  // of sqrt(g d)
  const std::string name = name_of(deck.experiment);
  const double diameter = dem::diameter_m(facts.grain());
  const double timestep = facts.timestep_s(deck.experiment);
  DeckFields fields = deck_fields(facts, deck.experiment);
  set_body(body, facts.study().model.grain_material.density_kg_m3, fields);
  set_pose(dem::lying_pose(facts.grain()), fields);
  fields.set("NAME", name);
  fields.set("BONDED", deck.bonded);
  fields.set("RATE", deck.rate_deg_s);
  fields.set("PLACES", deck.places);
  fields.set("PLACE_FILE", deck.place_file);
  fields.set("BODY_FILE", deck.body_file);
  fields.set("HEIGHT", height_m);
  fields.set("ROOM", body.reach_m() + 2 * kAround * facts.grain().reach_m());
  fields.set("DIAMETER", diameter);
  fields.set("STILL", kStill * std::sqrt(kStandardGravity_m_s2 * diameter) * kLook_s);
  fields.set("SETTLE_STEPS", steps(kSettle_s, timestep));
  fields.set("EVERY", steps(kLook_s, timestep));
  for (int k = 1; k <= deck.places; ++k) fields.add_section("PLACE").set("NUMBER", k);
  return {.name = name + ".lig", .text = filled("liggghts/tilt_on_grains.lig", fields)};
}

std::vector<ExportedFile> tilt_files(const ExportFacts& facts, const TiltDeck& deck) {
  const dem::ClumpShape& grain = facts.grain();
  const dem::ClumpShape body = dem::bonded_shape(grain, deck.bonded);
  dem::Random random(facts.study().seed);
  const dem::SphereBed bed = dem::glued_bed(grain, deck.coverage, random);
  const double half = body.reach_m() + kAround * grain.reach_m();
  std::vector<ExportedFile> files;
  for (int k = 1; k <= deck.places; ++k) {
    const double down = random.between(0, bed.tile);
    const double across = random.between(0, bed.tile) + dem::lane_m(body.reach_m()) * (k - 1);
    files.push_back(bed_file(facts, deck.experiment, k, bed_about(bed, {down, across, 0}, half)));
  }
  const double height =
      dem::top_m(bed) + dem::reach_towards(body, dem::lying_pose(grain), -dem::Vector::UnitZ());
  files.push_back(tilt_on_grains_file(facts, deck, body, height));
  return files;
}

std::vector<ExportedFile> row_files(const ExportFacts& facts) {
  const dem::GrainTiltProtocol& protocol = facts.study().protocol<dem::GrainTiltProtocol>();
  std::vector<ExportedFile> files =
      tilt_files(facts, {.experiment = dem::experiment_of<dem::GrainTiltProtocol>(),
                         .bonded = protocol.bonded,
                         .rate_deg_s = protocol.rate_deg_s,
                         .places = protocol.places,
                         .coverage = protocol.coverage,
                         .place_file = "place_row.lig",
                         .body_file = "row.txt"});
  files.push_back(place_file(facts, "place_row.lig", facts.is_sphere() && protocol.bonded == 1));
  files.push_back(
      {.name = "row.txt", .text = spheres_text(dem::bonded_shape(facts.grain(), protocol.bonded))});
  return files;
}

std::vector<ExportedFile> single_files(const ExportFacts& facts) {
  const dem::GrainRollProtocol& protocol = facts.study().protocol<dem::GrainRollProtocol>();
  return tilt_files(facts, {.experiment = dem::experiment_of<dem::GrainRollProtocol>(),
                            .bonded = 1,
                            .rate_deg_s = protocol.rate_deg_s,
                            .places = protocol.places,
                            .coverage = protocol.coverage,
                            .place_file = "place.lig",
                            .body_file = "clump.txt"});
}

void add(std::vector<ExportedFile> more, std::vector<ExportedFile>& files) {
  files.insert(files.end(), more.begin(), more.end());
}

}  // namespace

std::vector<ExportedFile> liggghts_files_on_grains(const ExportFacts& facts) {
  std::vector<ExportedFile> files;
  if (facts.has_deck(dem::experiment_of<dem::GrainDropProtocol>())) add(drop_files(facts), files);
  if (facts.has_deck(dem::experiment_of<dem::GrainTiltProtocol>())) add(row_files(facts), files);
  if (facts.has_deck(dem::experiment_of<dem::GrainRollProtocol>())) add(single_files(facts), files);
  return files;
}

namespace {

void add_pair(const dem::HangingPair& pair, int number, DeckFields& fields) {
  DeckFields& own = fields.add_section("PAIR");
  own.set("NUMBER", number);
  own.set("APART", pair.apart_m);
  own.set("AW", pair.swinging.w());
  own.set("AX", pair.swinging.x());
  own.set("AY", pair.swinging.y());
  own.set("AZ", pair.swinging.z());
  own.set("BW", pair.hanging.w());
  own.set("BX", pair.hanging.x());
  own.set("BY", pair.hanging.y());
  own.set("BZ", pair.hanging.z());
}

/// Pairs in the poses of our run with the study's first seed, each simulated separately.
ExportedFile pendulum_file(const ExportFacts& facts) {
  const dem::PendulumProtocol& protocol = facts.study().protocol<dem::PendulumProtocol>();
  const double timestep = facts.timestep_s(dem::experiment_of<dem::PendulumProtocol>());
  const double speed = dem::swing_speed_m_s(protocol);
  const double reach = facts.grain().reach_m();
  const double reach_s = reach / speed;
  DeckFields fields = deck_fields(facts, dem::experiment_of<dem::PendulumProtocol>());
  mark_shape(facts.is_sphere(), fields);
  fields.set("STRING", protocol.string_m);
  fields.set("STRING_MM", 1e3 * protocol.string_m);
  fields.set("RELEASE", protocol.release_deg);
  fields.set("PAIRS", protocol.pairs);
  fields.set("SPEED", speed);
  fields.set("ROOM", 2 * dem::kPendulumLongest * reach);
  fields.set("MEET_STEPS", steps(2 * dem::kPendulumGap * reach_s, timestep));
  fields.set("LOOK_STEPS", steps(dem::kPendulumLook * reach_s, timestep));
  fields.set("LONGEST_STEPS", steps(dem::kPendulumLongest * reach_s, timestep));
  dem::Random random(facts.study().seed);
  for (int k = 1; k <= protocol.pairs; ++k) {
    add_pair(dem::hanging_pair(facts.grain(), random), k, fields);
  }
  return {.name = "pendulum.lig", .text = filled("liggghts/pendulum.lig", fields)};
}

}  // namespace

std::vector<ExportedFile> liggghts_files_of_pairs(const ExportFacts& facts) {
  std::vector<ExportedFile> files;
  if (facts.has_deck(dem::experiment_of<dem::PendulumProtocol>()))
    files.push_back(pendulum_file(facts));
  return files;
}

namespace {

/// Height above the rim from which grains are poured, in bounding radii.
constexpr double kHeaped = 5;

/// The vessel to be filled, a tube or a box, and where grains come from.
struct Vessel {
  double section_m2 = 0;
  double floor_m = 0;
  double rim_m = 0;
  double spout_m = 0;  ///< grains are as fast as if they fell from there
};

/// How the grains are poured: layer by layer from just above the final heap, as fast as if they
/// came from the spout and as dense as ours. Grains that fall one by one pack 6 % denser.
struct Pouring {
  double grains = 0;     ///< in all
  double from_m = 0;     ///< height of a layer's centres
  double speed_m_s = 0;  ///< of its grains
  double layer_s = 0;    ///< between layers: until a layer has left its place
  double rate_s = 0;     ///< grains a second
};

Pouring pouring_of(const Vessel& vessel, const dem::ClumpShape& grain) {
  constexpr double kPacked = .6;
  constexpr double kCovered = .5;  // of the vessel's section: more do not fit at random
  constexpr double kApart = 2.02;  // bounding radii between layers
  const double reach = grain.reach_m();
  Pouring pouring;
  pouring.from_m = vessel.rim_m + kHeaped * reach;
  pouring.grains =
      std::ceil(kPacked * vessel.section_m2 * (pouring.from_m - vessel.floor_m) / grain.volume_m3);
  const double fall_m = std::max(reach, vessel.spout_m - pouring.from_m);
  pouring.speed_m_s = std::sqrt(2 * kStandardGravity_m_s2 * fall_m);
  pouring.layer_s = kApart * reach / pouring.speed_m_s;
  pouring.rate_s = std::ceil(kCovered * vessel.section_m2 / (std::numbers::pi * reach * reach)) /
                   pouring.layer_s;
  return pouring;
}

/// Values for pour.lig, and the region that grains may be in.
void set_pouring(const Pouring& pouring, double reach_m, double timestep_s, DeckFields& fields) {
  constexpr double kRest_s = .5;  // in which grains that have landed come to rest
  const double landed_s = std::sqrt(2 * pouring.from_m / kStandardGravity_m_s2);
  fields.set("GRAINS", static_cast<int>(pouring.grains));
  fields.set("RATE", pouring.rate_s);
  fields.set("SPEED", pouring.speed_m_s);
  fields.set("FROM", pouring.from_m);
  fields.set("TO", pouring.from_m + 1e-3 * reach_m);
  fields.set("TOP", pouring.from_m + 3 * reach_m);
  fields.set("LAYER_STEPS", steps(pouring.layer_s, timestep_s));
  fields.set("POUR_STEPS", steps(pouring.grains / pouring.rate_s, timestep_s));
  fields.set("REST_STEPS", steps(kRest_s + landed_s, timestep_s));
}

ExportedFile pour_file(const ExportFacts& facts) {
  DeckFields fields = common_fields(facts);
  mark_shape(facts.is_sphere(), fields);
  return {.name = "pour.lig", .text = filled("liggghts/pour.lig", fields)};
}

ExportedFile fill_file(const ExportFacts& facts) {
  const dem::FillProtocol& protocol = facts.study().protocol<dem::FillProtocol>();
  const double radius = .5 * protocol.tube_diameter_m;
  const double reach = facts.grain().reach_m();
  const Vessel tube{.section_m2 = std::numbers::pi * radius * radius,
                    .floor_m = 0,
                    .rim_m = protocol.tube_height_m,
                    .spout_m = protocol.tube_height_m + protocol.pour_m};
  DeckFields fields = deck_fields(facts, dem::experiment_of<dem::FillProtocol>());
  set_pouring(pouring_of(tube, facts.grain()), reach,
              facts.timestep_s(dem::experiment_of<dem::FillProtocol>()), fields);
  fields.set("POUR_MM", 1e3 * protocol.pour_m);
  fields.set("TUBE_RADIUS", radius);
  fields.set("RIM", tube.rim_m);
  fields.set("VOLUME", tube.section_m2 * tube.rim_m);
  fields.set("SPREAD", radius - reach);
  fields.set("ROOM", radius + 2 * reach);
  return {.name = "fill.lig", .text = filled("liggghts/fill.lig", fields)};
}

/// Height of a grain's highest sphere centre above the grain's own, mean over all poses. LIGGGHTS
/// removes every clump with a sphere above a level; raising the level by this height leaves the
/// same number of clumps.
double highest_centre_m(const dem::ClumpShape& grain) {
  constexpr int kPoses = 1000;
  dem::Random random(1);
  double sum = 0;
  for (int k = 0; k < kPoses; ++k) {
    const dem::Quaternion pose = random.orientation();
    double highest = -HUGE_VAL;
    for (const dem::ClumpSphere& sphere : grain.spheres) {
      highest = std::max(highest, (pose * sphere.centre).z());
    }
    sum += highest;
  }
  return sum / kPoses;
}

ExportedFile draw_down_file(const ExportFacts& facts) {
  constexpr double kFall = 4;  // bounding radii, as in our rain
  constexpr double kPart_s = 1;
  const dem::DrawDownProtocol& protocol = facts.study().protocol<dem::DrawDownProtocol>();
  const double timestep = facts.timestep_s(dem::experiment_of<dem::DrawDownProtocol>());
  const double reach = facts.grain().reach_m();
  const double floor_m = dem::upper_floor_m(protocol), rim_m = floor_m + protocol.fill_m;
  const Vessel box{.section_m2 = protocol.length_m * protocol.depth_m,
                   .floor_m = floor_m,
                   .rim_m = rim_m,
                   .spout_m = rim_m + (kHeaped + kFall) * reach};
  DeckFields fields = deck_fields(facts, dem::experiment_of<dem::DrawDownProtocol>());
  set_pouring(pouring_of(box, facts.grain()), reach, timestep, fields);
  mark_shape(facts.is_sphere(), fields);
  fields.set("SLOT_MM", 1e3 * protocol.slot_m);
  fields.set("END", .5 * protocol.length_m);
  fields.set("SIDE", .5 * protocol.depth_m);
  fields.set("SPREAD_X", .5 * protocol.length_m - reach);
  fields.set("SPREAD_Y", .5 * protocol.depth_m - reach);
  fields.set("ROOM_X", .5 * protocol.length_m + 2 * reach);
  fields.set("ROOM_Y", .5 * protocol.depth_m + 2 * reach);
  fields.set("DROP", protocol.drop_m);
  fields.set("STRIKE", rim_m + highest_centre_m(facts.grain()));
  fields.set("PART_STEPS", steps(kPart_s, timestep));
  return {.name = "draw_down.lig", .text = filled("liggghts/draw_down.lig", fields)};
}

}  // namespace

std::vector<ExportedFile> liggghts_files_of_poured_grains(const ExportFacts& facts) {
  const bool is_filled = facts.has_deck(dem::experiment_of<dem::FillProtocol>());
  const bool is_drawn_down = facts.has_deck(dem::experiment_of<dem::DrawDownProtocol>());
  std::vector<ExportedFile> files;
  if (is_filled || is_drawn_down) files.push_back(pour_file(facts));
  if (is_filled) files.push_back(fill_file(facts));
  if (is_drawn_down) {
    const dem::DrawDownProtocol& protocol = facts.study().protocol<dem::DrawDownProtocol>();
    files.push_back(draw_down_file(facts));
    files.push_back({.name = "slotted_floor.stl", .text = slotted_floor_stl(protocol)});
    files.push_back({.name = "gate.stl", .text = gate_stl(protocol)});
  }
  return files;
}

}  // namespace repose::calibrate
