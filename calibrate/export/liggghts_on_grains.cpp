#include <cmath>
#include <string>

#include "base/units.h"
#include "calibrate/export/liggghts_decks.h"
#include "dem/experiment/bonded.h"
#include "dem/experiment/glued_bed.h"
#include "dem/experiment/placing.h"
#include "dem/experiment/spacing.h"
#include "dem/study/experiment_table.h"

namespace repose::calibrate {
namespace {

/// How far about its place a grain may come to touch the bed, in its reaches.
constexpr double kAround = 8;
/// In which grains that fall into the hollows of a bed come to rest.
constexpr double kSettle_s = .5;

/// The part of a bed, which repeats itself, about a place: a square, that place at its origin.
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

/// Numbers are drawn in the order of our simulation with the study's first seed: the same bed, the
/// same poses and places.
std::vector<ExportedFile> drop_files(const ExportFacts& facts) {
  const dem::GrainDropProtocol& protocol = facts.study().protocol<dem::GrainDropProtocol>();
  const dem::ClumpShape& grain = facts.grain();
  dem::Random random(facts.study().seed);
  const dem::SphereBed bed = dem::glued_bed(grain, protocol.coverage, random);
  const double top = dem::top_m(bed);
  const double apart = dem::drop_spacing_m(protocol.height_m, grain.reach_m());
  DropDeck deck{.experiment = dem::Experiment::drop_on_grains,
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

/// Bodies of grains on a board that tilts.
struct TiltDeck {
  dem::Experiment experiment = dem::Experiment::tilt_on_grains;
  int bonded = 1;
  double rate_deg_s = 0;
  int places = 1;
  double coverage = 0;
  std::string place_file;  ///< that puts a body in, and the spheres of one
  std::string body_file;
};

/// As our simulation does it, see dem/experiment/tilt_on_grains.cpp.
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
      tilt_files(facts, {.experiment = dem::Experiment::tilt_on_grains,
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
  return tilt_files(facts, {.experiment = dem::Experiment::roll_on_grains,
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
  if (facts.has_deck(dem::Experiment::drop_on_grains)) add(drop_files(facts), files);
  if (facts.has_deck(dem::Experiment::tilt_on_grains)) add(row_files(facts), files);
  if (facts.has_deck(dem::Experiment::roll_on_grains)) add(single_files(facts), files);
  return files;
}

}  // namespace repose::calibrate
