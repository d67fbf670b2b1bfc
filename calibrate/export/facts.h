#pragma once

#include <string>
#include <vector>

#include "calibrate/export/deck_template.h"
#include "calibrate/export/export.h"
#include "dem/contact/contact_table.h"
#include "dem/engine/simulation.h"
#include "dem/experiment/heap.h"

namespace repose::calibrate {

/// A grain's pose and the height of its centre of mass when it touches a level wall below it.
struct TouchingPose {
  dem::Quaternion orientation = dem::Quaternion::Identity();
  double height_m = 0;
};

/// What the exports are made from: a study with a value for each coefficient that it needs.
class ExportFacts {
 public:
  /// @throws base::InputError  coefficients have no value: all of them.
  ExportFacts(dem::Study study, dem::ClumpShape grain, std::vector<FittedValue> fitted,
              ExportTarget target);

  const dem::Study& study() const { return study_; }
  const dem::ClumpShape& grain() const { return study_.model.grain; }
  const std::vector<FittedValue>& fitted() const { return fitted_; }
  double mass_kg() const;
  /// Then other programs work out mass and inertia themselves, of a ball of `ball_density_kg_m3`.
  bool is_sphere() const { return grain().spheres.size() == 1; }
  /// With which the first sphere alone has the grain's mass.
  double ball_density_kg_m3() const;
  bool has(dem::Experiment experiment) const { return dem::has_protocol(study_, experiment); }
  /// Of those that the study has the ones that the target has a deck for; for EDEM, which has none,
  /// all of them. In the order of dem::all_experiments(), as the others.
  std::vector<dem::Experiment> experiments() const;
  std::vector<dem::Experiment> left_out() const;
  bool has_deck(dem::Experiment experiment) const;
  /// Parts of another material than the plate's that one of these has.
  std::vector<dem::WallPart> parts() const;
  const dem::WallSurface& surface(dem::WallPart part) const { return study_.model.parts.at(part); }
  /// What a pair does in an experiment that has the part.
  dem::ContactLaw law(dem::Experiment experiment, dem::WallPart part) const;
  /// Grains touch each other in one of the study's experiments, with a deck or not.
  bool has_grain_contacts() const;

  /// Materials and coefficients as an experiment has them, softened as there.
  dem::ContactTable contacts(dem::Experiment experiment) const;
  double stiffness(dem::Experiment experiment) const;
  /// Half of the longest step that our engine accepts there for impacts, s.
  double timestep_s(dem::Experiment experiment) const;
  /// From now on bulks have half of the longest step that ours take, which are four times as long.
  /// Single grains, which slide and roll for long, would creep.
  void take_longer_steps() { has_longer_steps_ = true; }

  /// Poses of the drop, as simulated with the study's first seed.
  std::vector<TouchingPose> drop_poses() const;
  /// Of the fastest impact that an experiment may see, m/s; of a drop, after the fall.
  double speed_m_s(dem::Experiment experiment) const;
  /// Until each dropped grain has had its first flight: as long as the fall took, there and back,
  /// and the time to topple.
  double longest_drop_s(dem::Experiment drop) const;
  /// Bonded grains of the tilt, and how they lie.
  dem::ClumpShape tilt_body() const;
  TouchingPose tilt_pose() const;
  /// Angle at which the plate begins to turn.
  double tilt_begin_deg() const;
  /// Where the grain of the roll is let go, with the study's first seed; and all releases, of which
  /// each is for a grain that stayed on the incline before.
  dem::Grain roll_start() const;
  std::vector<dem::Grain> roll_starts() const;
  /// A length of the flat that no grain passes, m.
  double roll_flat_m() const;

 private:
  dem::Study study_;
  std::vector<FittedValue> fitted_;
  ExportTarget target_;
  bool has_longer_steps_ = false;
};

/// Young's modulus and Poisson's ratio of which two equal bodies have the E* and G* of a pair.
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

/// Title, names and coefficients, which every template may use.
DeckFields common_fields(const ExportFacts& facts);

/// Mass and principal moments of inertia: BODY_MASS, IXX, IYY, IZZ, and SPHERES, how many.
void set_body(const dem::ClumpShape& shape, double density_kg_m3, DeckFields& fields);
/// Its spheres, a section BALL each: X, Y, Z, R.
void add_balls(const dem::ClumpShape& shape, DeckFields& fields);
/// QW, QX, QY, QZ.
void set_pose(const dem::Quaternion& orientation, DeckFields& fields);
/// As many steps as a time takes, in digits.
std::string steps(double time_s, double timestep_s);
/// How many grains fill the heap's tube: the protocol's number, or as many as are poured.
int grains_in_heap(const ExportFacts& facts);
/// Time in which the tube is lifted clear of any heap, s, and time to come to rest after that.
double lift_s(const dem::HeapProtocol& protocol);
inline constexpr double kHeapRest_s = 5;

}  // namespace repose::calibrate
