#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/units.h"
#include "dem/engine/simulation.h"
#include "dem/verify/case_peer.h"
#include "dem/verify/verify.h"

namespace repose::dem {

class Trial;

/// A setup with a known outcome.
struct VerifyCase {
  std::string name;
  std::string source;
  std::function<void(Trial&)> run;
};

/// One run of a case: at one fraction of the accepted time step, of our engine or of another
/// program. Collects what comes out.
class Trial {
 public:
  /// `peer`: the other program; none: our engine.
  Trial(const VerifyCase& which, double timestep_fraction, const CasePeer* peer = nullptr);

  /// Collisions, each by itself, in steps that are this trial's share of the longest that is
  /// accepted for impacts at up to `speed_m_s`; as collide() below.
  /// @throws CannotRun  the other program cannot make them; so do all others.
  std::vector<Collision> collide_each(SimulationSetup setup, const std::vector<Meeting>& meetings,
                                      double speed_m_s, double radius);
  Collision collide(SimulationSetup setup, const Meeting& meeting, double speed_m_s,
                    double radius) {
    return collide_each(std::move(setup), {meeting}, speed_m_s, radius).front();
  }

  /// Grain 0 from its start for so long.
  Path follow(SimulationSetup setup, const std::vector<Grain>& grains, double speed_m_s,
              double duration_s, int every_steps = 1);

  /// The simulation of a setup, for cases that do more with it than to look on: only ours.
  Simulation simulate(SimulationSetup setup, double speed_m_s);

  /// Holds when `measured` is no further than `tolerance` from `expected`.
  void expect(const std::string& quantity, double expected, double measured, double tolerance);

  const std::vector<CaseResult>& results() const { return results_; }

  /// What the steps of these are.
  double timestep_s(const SimulationSetup& setup, double speed_m_s) const;

 private:
  void take_timestep(SimulationSetup& setup, double speed_m_s);

  const CasePeer* peer_;
  std::string name_;
  std::string source_;
  double timestep_share_;
  double timestep_s_ = 0;  ///< of the latest simulation
  std::vector<CaseResult> results_;
};

/// Central impacts: Chung & Ooi T1-T3, restitution, bounce heights.
std::vector<VerifyCase> impact_cases();
/// Impacts of clumps on several spheres at once.
std::vector<VerifyCase> clump_cases();
/// Impacts with sliding: Chung & Ooi T4-T8.
std::vector<VerifyCase> oblique_cases();
/// Impacts measured by Kharaz et al.
std::vector<VerifyCase> kharaz_cases();
/// Sliding, and rolling without resistance.
std::vector<VerifyCase> motion_cases();
/// The three models of rolling resistance.
std::vector<VerifyCase> rolling_cases();
/// Free rotation.
std::vector<VerifyCase> rotation_cases();
/// Beds of fixed spheres.
std::vector<VerifyCase> bed_cases();
/// Energy and momentum of collisions.
std::vector<VerifyCase> conservation_cases();

/// Grains of one kind (material 0) and a wall's material (1), the same coefficients for all pairs.
/// No walls and no gravity yet.
SimulationSetup scene_of(const ClumpShape& shape, const Material& grain, const Material& wall,
                         const PairCoefficients& pair, RollingModel rolling = RollingModel::none,
                         DampingModel damping = DampingModel::per_contact);

inline constexpr double kBallRadius_m = .01;
/// The ball of the cases about sliding and rolling, soft so that steps are long, on its own kind.
SimulationSetup ball_scene(const PairCoefficients& pair, RollingModel rolling = RollingModel::none);

/// A block with a sphere in each corner that just touches its three faces; mass and inertia of the
/// block.
ClumpShape block_shape(const Vector& half_size, double sphere_radius);

/// Material 1; falls towards +x by `tilt`.
Wall tilted_plane(double tilt_rad);

/// A sphere that rests on tilted_plane: overlapping by what its weight asks for, at the origin.
Grain resting_sphere(const SimulationSetup& setup, double tilt_rad);

/// Down the slope of tilted_plane.
Vector downhill(double tilt_rad);

/// Follows a collision until grain 0, which comes near from above, touches nothing any more.
/// Without gravity. `radius` is that of the smaller sphere.
Collision collide(Simulation& simulation, double radius);

/// Throws a sphere at a flat wall, from where it all but touches: from (0, 0, r) at the wall z = 0.
Collision strike_wall(Trial& trial, SimulationSetup setup, const Vector& velocity,
                      const Vector& spin = Vector::Zero());

}  // namespace repose::dem
