#include "calibrate/export/liggghts_decks.h"
#include "dem/experiment/hanging_pair.h"

namespace repose::calibrate {
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

/// Pairs in the poses of our run with the study's first seed, each on its own.
ExportedFile pendulum_file(const ExportFacts& facts) {
  const dem::PendulumProtocol& protocol = facts.study().protocol<dem::PendulumProtocol>();
  const double timestep = facts.timestep_s(dem::Experiment::pendulum);
  const double speed = dem::swing_speed_m_s(protocol);
  const double reach = facts.grain().reach_m();
  const double reach_s = reach / speed;
  DeckFields fields = deck_fields(facts, dem::Experiment::pendulum);
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
  if (facts.has_deck(dem::Experiment::pendulum)) files.push_back(pendulum_file(facts));
  return files;
}

}  // namespace repose::calibrate
