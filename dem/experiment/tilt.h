#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dem/engine/simulation.h"
#include "dem/experiment/experiment.h"
#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// Grains bonded side by side on a plate that tilts until they slide.
///
/// The grains touch, long axes parallel and horizontal, shortest axes normal to the plate. The
/// plate turns about the direction of the long axes, so the row of grains points down the slope,
/// the only direction in which it can neither roll nor rock. A single grain rolls.
///
/// Value: the plate's angle at the onset of sliding, degrees. Slip grows as the cube of the time
/// since the onset; a line fitted to its cube root is extrapolated to zero slip. Readings:
/// "half_mm_slip_deg" (the plate's angle once the body has slipped half a millimetre, as others
/// report it) and "begin_deg" (where the turning began). Throws NoMeasurement for a body that tips
/// or rolls, creeps from the start, or holds up to 89 degrees. Restitution does not matter: values
/// above .5 are replaced by .5, or bodies would rattle. The test is deterministic: the seed changes
/// nothing. Randomness would not help: as long as the body slides, its angle is that of friction
/// whatever its pose, and with the row across the slope ellipsoids roll over their ends once
/// tan(angle) = (a^2 - b^2) / 2ab (half-axes a > b: 14 degrees for a hazelnut), before they slide.
/// Scatter on the bench comes from its surfaces.
struct TiltProtocol {
  int bonded = 2;
  double rate_deg_s = 2;
  /// Lower limit. The plate starts later, just short of where the body slides or tips, since a body
  /// at rest has no history: Tilt.DoesNotDependOnWhereItBegins.
  double start_deg = 0;
};

Repeat run_tilt(const Model& model, const TiltProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});

/// The model with contacts that do not rattle, as simulated by run_tilt().
Model quiet(Model model);

/// Slope at which a body in this pose tips over the sphere on the plate that is farthest down the
/// slope (+x).
double tipping_deg(const ClumpShape& body, const Quaternion& pose);

/// Record of a sliding body, from this or another program.
struct Slide {
  std::vector<double> angle_deg;  ///< of the plate, for slips that the onset is fitted to
  std::vector<double> slip_m;
  std::optional<double> reported_deg;  ///< at half a millimetre

  void add(double at_deg, double slipped_m, const ClumpShape& grain);
};

/// Slip at which the record is complete, m.
double most_slip_m(const ClumpShape& grain);

/// Angle at the onset of slip.
///
/// Just past the onset theta0 (t0) the body's acceleration along the plate is g (sin theta - mu cos
/// theta) = g sin(theta - theta0) / cos theta0 = c (t - t0) for a plate that turns steadily, so
/// slip = c (t - t0)^3 / 6: its cube root is a line that starts from 0 at t0. With c = g rate / cos
/// theta0 the line rises by cbrt(g / (6 rate^2 cos theta0)) per radian that the plate turns. A body
/// that creeps from the start, or is shaken loose, slips differently. Proved by
/// TiltFriction.IsTheAngleOfSliding in tests/dem/experiment_tilt_test.cpp.
/// @throws NoMeasurement  it slips differently.
double onset_deg(const Slide& slide, double begin_deg, double rate_deg_s);

/// Angle at which a plate stops turning.
inline constexpr double kSteepest_deg = 89;
/// Up to this rate the onset is within .01 degrees; at 50 it is half a degree low.
inline constexpr double kFastest_deg_s = 10;

/// Rotation about y by an angle: +x then points down the slope.
Quaternion slope(double angle_deg);

/// Position and rotation of a grain in the frame of a wall.
Vector on_plate(const Simulation& simulation, int wall, int grain);
Quaternion turn_on_plate(const Simulation& simulation, int wall, int grain);

/// `count` grains that touch, all oriented the same way, as one rigid grain.
///
/// They form a row along their middle axis: in lying_pose() the row lies along x. Mass and inertia
/// are those of the grains' own surfaces, by the parallel axis theorem (Goldstein, Poole, Safko
/// 2002, Classical Mechanics, sec. 5.3): a row along a principal axis keeps the principal axes and
/// adds the mean square distance from its centre to the other two moments. Proved by Bonded.* in
/// tests/dem/experiment_bonded_test.cpp. The surface is left empty.
ClumpShape bonded_shape(const ClumpShape& grain, int count);

}  // namespace repose::dem
