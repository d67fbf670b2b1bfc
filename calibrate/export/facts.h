#pragma once

#include <string>
#include <vector>

#include "calibrate/export/deck_template.h"
#include "calibrate/export/export.h"
#include "dem/contact/contact_table.h"
#include "dem/engine/simulation.h"
#include "dem/experiment/heap.h"

namespace repose::calibrate {

/// A grain's pose and the height of its centre of mass when touching a level wall below it.
struct TouchingPose {
  dem::Quaternion orientation = dem::Quaternion::Identity();
  double height_m = 0;
};

/// The data that exports are made from: a study with a value for each coefficient that it needs.
class ExportFacts {
 public:
  /// @throws base::InputError  listing all coefficients that have no value.
  ExportFacts(dem::Study study, dem::ClumpShape grain, std::vector<FittedValue> fitted,
              ExportTarget target);

  const dem::Study& study() const { return study_; }
  const dem::ClumpShape& grain() const { return study_.model.grain; }
  const std::vector<FittedValue>& fitted() const { return fitted_; }
  double mass_kg() const;
  /// If so, other programs compute mass and inertia themselves, from a ball of
  /// `ball_density_kg_m3`.
  bool is_sphere() const { return grain().spheres.size() == 1; }
  /// The density at which the first sphere alone has the grain's mass.
  double ball_density_kg_m3() const;
  bool has(dem::Experiment experiment) const { return dem::has_protocol(study_, experiment); }
  /// The study's experiments that the target has a deck for; for EDEM, which has no decks, all of
  /// them. In the order of dem::all_experiments(), like left_out().
  std::vector<dem::Experiment> experiments() const;
  std::vector<dem::Experiment> left_out() const;
  bool has_deck(dem::Experiment experiment) const;
  /// Parts in these experiments whose material differs from the plate's.
  std::vector<dem::WallPart> parts() const;
  const dem::WallSurface& surface(dem::WallPart part) const { return study_.model.parts.at(part); }
  /// The law of grain and part in an experiment that has the part.
  dem::ContactLaw law(dem::Experiment experiment, dem::WallPart part) const;
  /// Whether grains touch each other in any of the study's experiments, with a deck or not.
  bool has_grain_contacts() const;

  /// Materials and coefficients of an experiment, softened as there.
  dem::ContactTable contacts(dem::Experiment experiment) const;
  double stiffness(dem::Experiment experiment) const;
  /// Half of the longest step that our engine accepts for impacts in this experiment, s.
  double timestep_s(dem::Experiment experiment) const;
  /// From now on bulk experiments use half of the longest step that ours use for them, four times
  /// as long as for impacts. Single grains, which slide and roll for a long time, would creep.
  void take_longer_steps() { has_longer_steps_ = true; }

  /// Poses of the drop, as simulated with the study's first seed.
  std::vector<TouchingPose> drop_poses() const;
  /// Of the fastest impact possible in an experiment, m/s; for a drop, after the fall.
  double speed_m_s(dem::Experiment experiment) const;
  /// Time until every dropped grain has completed its first flight, s: twice the fall time, and the
  /// time to topple.
  double longest_drop_s(dem::Experiment drop) const;
  /// The bonded grains of the tilt, and their pose.
  dem::ClumpShape tilt_body() const;
  TouchingPose tilt_pose() const;
  /// Angle at which the plate begins to turn.
  double tilt_begin_deg() const;
  /// Where the grain of the roll is released, with the study's first seed; and all releases, each
  /// used if the grain stayed on the incline in the one before.
  dem::Grain roll_start() const;
  std::vector<dem::Grain> roll_starts() const;
  /// A length of the flat beyond which no grain rolls, m.
  double roll_flat_m() const;

 private:
  dem::Study study_;
  std::vector<FittedValue> fitted_;
  ExportTarget target_;
  bool has_longer_steps_ = false;
};

/// Young's modulus and Poisson's ratio of two equal bodies that have the E* and G* of a pair.
struct LikeMaterial {
  double young_modulus_pa = 0;
  double poisson_ratio = 0;
};

/// E* = E / 2(1 - nu^2) and G* = E / 4(2 - nu)(1 + nu) of two equal bodies (Johnson 1985, Contact
/// Mechanics, eqs. 4.24 and 7.43), solved for E and nu: with q = G*/E*, nu = (1 - 4q)/(1 - 2q).
/// Proved by ExportFacts.TwoLikeBodiesHaveThePairsModuli in tests/calibrate/export_facts_test.cpp.
LikeMaterial like_material(const dem::ContactLaw& pair);

/// Stiffness of the rolling spring of `elastic_plastic` under a grain's own weight on a wall,
/// N m/rad: k_r = 2.25 k_n (mu_r R)^2 (see dem/THEORY.md). For targets whose spring does not change
/// with the load.
double rolling_stiffness(const dem::ContactLaw& pair, double mass_kg, double radius_m);

/// Title, names and coefficients, for every template.
DeckFields common_fields(const ExportFacts& facts);

/// Mass and principal moments of inertia: BODY_MASS, IXX, IYY, IZZ, and SPHERES, how many.
void set_body(const dem::ClumpShape& shape, double density_kg_m3, DeckFields& fields);
/// Adds the spheres, a section BALL each: X, Y, Z, R.
void add_balls(const dem::ClumpShape& shape, DeckFields& fields);
/// QW, QX, QY, QZ.
void set_pose(const dem::Quaternion& orientation, DeckFields& fields);
/// The number of steps in a time, as text.
std::string steps(double time_s, double timestep_s);
/// How many grains fill the heap's tube: the protocol's number, or as many as fit.
int grains_in_heap(const ExportFacts& facts);
/// Time in which the tube is lifted clear of any heap, s; and below, time to come to rest after
/// that.
double lift_s(const dem::HeapProtocol& protocol);
inline constexpr double kHeapRest_s = 5;

}  // namespace repose::calibrate
