#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibrate/export/liggghts_decks.h"
#include "dem/experiment/hanging_pair.h"

namespace repose::calibrate {
namespace {

using dem::Experiment;

/// In which grains that have landed come to rest.
constexpr double kRest_s = .5;

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

/// Pairs in the poses of our run with the study's first seed, each on its own.
ExportedFile pendulum_file(const ExportFacts& facts) {
  const dem::PendulumProtocol& protocol = facts.study().protocol<dem::PendulumProtocol>();
  const double timestep = facts.timestep_s(Experiment::pendulum);
  const double speed = dem::swing_speed_m_s(protocol);
  const double reach = facts.grain().reach_m();
  const double reach_s = reach / speed;
  DeckFields fields = deck_fields(facts, Experiment::pendulum);
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

Pouring pouring_of(const dem::FillProtocol& protocol, const dem::ClumpShape& grain) {
  constexpr double kPacked = .6;
  constexpr double kHeaped = 5;    // reaches over the rim
  constexpr double kCovered = .5;  // of the tube's section: more do not fit at random
  constexpr double kApart = 2.02;  // reaches from layer to layer
  const double reach = grain.reach_m();
  const double radius = .5 * protocol.tube_diameter_m;
  Pouring pouring;
  pouring.from_m = protocol.tube_height_m + kHeaped * reach;
  pouring.grains =
      std::ceil(kPacked * std::numbers::pi * radius * radius * pouring.from_m / grain.volume_m3);
  const double fall_m = std::max(reach, protocol.tube_height_m + protocol.pour_m - pouring.from_m);
  pouring.speed_m_s = std::sqrt(2 * dem::kStandardGravity_m_s2 * fall_m);
  pouring.layer_s = kApart * reach / pouring.speed_m_s;
  pouring.rate_s = std::ceil(kCovered * radius * radius / (reach * reach)) / pouring.layer_s;
  return pouring;
}

ExportedFile fill_file(const ExportFacts& facts) {
  const dem::FillProtocol& protocol = facts.study().protocol<dem::FillProtocol>();
  const double timestep = facts.timestep_s(Experiment::fill);
  const double radius = .5 * protocol.tube_diameter_m;
  const double reach = facts.grain().reach_m();
  const Pouring pouring = pouring_of(protocol, facts.grain());
  DeckFields fields = deck_fields(facts, Experiment::fill);
  mark_shape(facts.is_sphere(), fields);
  fields.set("POUR_MM", 1e3 * protocol.pour_m);
  fields.set("GRAINS", static_cast<int>(pouring.grains));
  fields.set("RATE", pouring.rate_s);
  fields.set("TUBE_RADIUS", radius);
  fields.set("RIM", protocol.tube_height_m);
  fields.set("VOLUME", std::numbers::pi * radius * radius * protocol.tube_height_m);
  fields.set("FROM", pouring.from_m);
  fields.set("TO", pouring.from_m + 1e-3 * reach);
  fields.set("SPREAD", radius - reach);
  fields.set("SPEED", pouring.speed_m_s);
  fields.set("ROOM", radius + 2 * reach);
  fields.set("TOP", pouring.from_m + 3 * reach);
  fields.set("LAYER_STEPS", steps(pouring.layer_s, timestep));
  fields.set("POUR_STEPS", steps(pouring.grains / pouring.rate_s, timestep));
  fields.set("REST_STEPS",
             steps(kRest_s + std::sqrt(2 * pouring.from_m / dem::kStandardGravity_m_s2), timestep));
  return {.name = "fill.lig", .text = filled("liggghts/fill.lig", fields)};
}

}  // namespace

std::vector<ExportedFile> liggghts_files_between_grains(const ExportFacts& facts) {
  std::vector<ExportedFile> files;
  if (facts.has_deck(Experiment::fill)) files.push_back(fill_file(facts));
  if (facts.has_deck(Experiment::pendulum)) files.push_back(pendulum_file(facts));
  return files;
}

}  // namespace repose::calibrate
