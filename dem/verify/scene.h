#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/units.h"
#include "dem/engine/simulation.h"
#include "dem/verify/verify.h"

namespace repose::dem {

class Trial;

/// A setup with a known outcome.
struct VerifyCase {
  std::string name;
  std::string source;
  std::function<void(Trial&)> run;
};

/// One run of a case: at one fraction of the accepted time step. Collects what comes out.
class Trial {
 public:
  Trial(const VerifyCase& which, double timestep_fraction);

  /// The simulation of a setup, with this trial's share of the longest time step that is accepted
  /// for impacts at up to `speed_m_s`.
  Simulation simulate(SimulationSetup setup, double speed_m_s);

  /// Holds when `measured` is no further than `tolerance` from `expected`.
  void expect(const std::string& quantity, double expected, double measured, double tolerance);

  const std::vector<CaseResult>& results() const { return results_; }

 private:
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

class Trial;

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

/// What happened while grain 0 touched something.
struct Collision {
  Grain after;
  double deepest_m = 0;
  double peak_n = 0;  ///< greatest push along `away`
  double pull_n = 0;  ///< greatest pull; 0 when it never pulled
  double duration_s = 0;
};

/// Follows a collision until grain 0, which comes near, touches nothing any more. Without gravity.
///
/// Peaks and duration are interpolated between steps. `away` is the unit vector from what is struck
/// to grain 0, `radius` that of the smaller sphere.
Collision collide(Simulation& simulation, const Vector& away, double radius);

/// Throws a sphere at a flat wall, from where it all but touches: from (0, 0, r) at the wall z = 0.
Collision strike_wall(Trial& trial, SimulationSetup setup, const Vector& velocity,
                      const Vector& spin = Vector::Zero());

}  // namespace repose::dem
