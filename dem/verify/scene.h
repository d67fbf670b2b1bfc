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

/// One run of a case: at one fraction of the accepted time step, in our engine or another program.
/// Collects the results.
class Trial {
 public:
  /// `peer`: the other program; null: our engine.
  Trial(const VerifyCase& which, double timestep_fraction, const CasePeer* peer = nullptr);

  /// Independent collisions, with this trial's share of the longest time step accepted for impacts
  /// at up to `speed_m_s`; as collide() below.
  /// @throws CannotRun  the other program cannot run them; likewise for the functions below.
  std::vector<Collision> collide_each(SimulationSetup setup, const std::vector<Meeting>& meetings,
                                      double speed_m_s, double radius);
  Collision collide(SimulationSetup setup, const Meeting& meeting, double speed_m_s,
                    double radius) {
    return collide_each(std::move(setup), {meeting}, speed_m_s, radius).front();
  }

  /// Path of grain 0 from its start, for `duration_s`.
  Path follow(SimulationSetup setup, const std::vector<Grain>& grains, double speed_m_s,
              double duration_s, int every_steps = 1);

  /// The simulation of a setup, for cases that intervene in it: our engine only.
  Simulation simulate(SimulationSetup setup, double speed_m_s);

  /// Adds a result, which holds if `measured` is within `tolerance` of `expected`.
  void expect(const std::string& quantity, double expected, double measured, double tolerance);

  const std::vector<CaseResult>& results() const { return results_; }

  /// Time step of the functions above, s.
  double timestep_s(const SimulationSetup& setup, double speed_m_s) const;

 private:
  void take_timestep(SimulationSetup& setup, double speed_m_s);

  const CasePeer* peer_;
  std::string name_;
  std::string source_;
  double timestep_share_;
  double timestep_s_ = 0;  ///< of the latest run
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
/// The ball of the sliding and rolling cases, soft to allow long steps, with walls of its own
/// material.
SimulationSetup ball_scene(const PairCoefficients& pair, RollingModel rolling = RollingModel::none);

/// A block with a sphere in each corner touching its three faces; mass and inertia are the block's.
ClumpShape block_shape(const Vector& half_size, double sphere_radius);

/// Material 1; descends towards +x at angle `tilt_rad`.
Wall tilted_plane(double tilt_rad);

/// A sphere resting on tilted_plane at the origin, with the overlap that its weight causes.
Grain resting_sphere(const SimulationSetup& setup, double tilt_rad);

/// Unit vector down the slope of tilted_plane.
Vector downhill(double tilt_rad);

/// Follows a collision until grain 0, which approaches from above, has separated. Without gravity.
/// `radius` is that of the smaller sphere.
Collision collide(Simulation& simulation, double radius);

/// Throws a sphere at the wall z = 0, from the point of first contact, (0, 0, r).
Collision strike_wall(Trial& trial, SimulationSetup setup, const Vector& velocity,
                      const Vector& spin = Vector::Zero());

}  // namespace repose::dem
