#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"
#include "calibrate/export/liggghts_decks.h"
#include "calibrate/export/stl.h"
#include "dem/experiment/draw_down_boxes.h"
#include "dem/experiment/random.h"

namespace repose::calibrate {
namespace {

/// Reaches of a grain over the rim, from where grains are poured.
constexpr double kHeaped = 5;

/// What is filled, a tube or a box, and from where.
struct Vessel {
  double section_m2 = 0;
  double floor_m = 0;
  double rim_m = 0;
  double spout_m = 0;  ///< grains are as fast as if they came from there
};

/// How the grains are poured: layer after layer just above where the heap will end, as fast as if
/// they came from the spout and as dense as ours. Grains that fall one by one come to lie 6 %
/// denser.
struct Pouring {
  double grains = 0;     ///< in all
  double from_m = 0;     ///< height of a layer's centres
  double speed_m_s = 0;  ///< of its grains
  double layer_s = 0;    ///< from layer to layer: until it has left its place
  double rate_s = 0;     ///< grains a second
};

Pouring pouring_of(const Vessel& vessel, const dem::ClumpShape& grain) {
  constexpr double kPacked = .6;
  constexpr double kCovered = .5;  // of the vessel's section: more do not fit at random
  constexpr double kApart = 2.02;  // reaches from layer to layer
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

/// What pour.lig reads, and where grains may be.
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
  DeckFields fields = deck_fields(facts, dem::Experiment::fill);
  set_pouring(pouring_of(tube, facts.grain()), reach, facts.timestep_s(dem::Experiment::fill),
              fields);
  fields.set("POUR_MM", 1e3 * protocol.pour_m);
  fields.set("TUBE_RADIUS", radius);
  fields.set("RIM", tube.rim_m);
  fields.set("VOLUME", tube.section_m2 * tube.rim_m);
  fields.set("SPREAD", radius - reach);
  fields.set("ROOM", radius + 2 * reach);
  return {.name = "fill.lig", .text = filled("liggghts/fill.lig", fields)};
}

/// How far the highest centre of a grain's spheres lies above the grain's, mean of all poses. A
/// level that is as much higher leaves as many clumps, of which LIGGGHTS takes away any that has a
/// sphere above it.
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
  constexpr double kFall = 4;  // reaches, as of our rain
  constexpr double kPart_s = 1;
  const dem::DrawDownProtocol& protocol = facts.study().protocol<dem::DrawDownProtocol>();
  const double timestep = facts.timestep_s(dem::Experiment::draw_down);
  const double reach = facts.grain().reach_m();
  const double floor_m = dem::upper_floor_m(protocol), rim_m = floor_m + protocol.fill_m;
  const Vessel box{.section_m2 = protocol.length_m * protocol.depth_m,
                   .floor_m = floor_m,
                   .rim_m = rim_m,
                   .spout_m = rim_m + (kHeaped + kFall) * reach};
  DeckFields fields = deck_fields(facts, dem::Experiment::draw_down);
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
  const bool is_filled = facts.has_deck(dem::Experiment::fill);
  const bool is_drawn_down = facts.has_deck(dem::Experiment::draw_down);
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
