#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dem/engine/simulation.h"
#include "dem/experiment/experiment.h"
#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// Grains bonded side by side, on a plate that tilts until they slide.
///
/// The grains touch, long axes parallel and level, shortest axes upright. The plate turns about
/// the direction of the long axes: down the slope lies the line from grain to grain, the one way in
/// which they can neither roll nor rock. A single grain rolls.
///
/// Value: the plate's angle at the onset of sliding, degrees. Slip grows as the cube of the time
/// since the onset; the line through its cube root is followed back to no slip. Readings:
/// "half_mm_slip_deg" (the plate's angle once the body has slipped half a millimetre; what others
/// report) and "begin_deg" (where the turning began). Throws NoMeasurement for a body that tips or
/// rolls, creeps from where the turning began, or holds up to 89 degrees. Restitution does not
/// matter: plates of more than .5 are taken to have .5, or bodies would rattle. There is no chance
/// in it: the seed changes nothing. Nor would chance be of use: as long as the body slides, its
/// angle is that of friction whatever its pose, and with the row across the slope ellipsoids roll
/// over their ends once tan(angle) = (a^2 - b^2) / 2ab (half-axes a > b: 14 degrees for a
/// hazelnut), before they slide. The scatter of a bench is that of its surfaces.
struct TiltProtocol {
  int bonded = 2;
  double rate_deg_s = 2;
  /// At least. The plate begins later, just short of where the body slides or tips, since a body
  /// that does not move has no history: Tilt.DoesNotDependOnWhereItBegins.
  double start_deg = 0;
};

Repeat run_tilt(const Model& model, const TiltProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});

/// The same bench with contacts that do not rattle: what run_tilt() simulates.
Model quiet(Model model);

/// Slope at which a body that lies so tips over the lowest of its spheres farthest down the slope
/// (+x).
double tipping_deg(const ClumpShape& body, const Quaternion& pose);

/// What is noted while a body slides, here or in another program.
struct Slide {
  std::vector<double> angle_deg;  ///< of the plate, within the slip that the onset is read from
  std::vector<double> slip_m;
  std::optional<double> reported_deg;  ///< at half a millimetre

  void add(double at_deg, double slipped_m, const ClumpShape& grain);
};

/// How far a body must slip until all is noted, m.
double most_slip_m(const ClumpShape& grain);

/// Angle at which the slip began.
///
/// Just past the onset theta0 (t0) the body's acceleration along the plate is
/// g (sin theta - mu cos theta) = g sin(theta - theta0) / cos theta0 = c (t - t0) for a plate that
/// turns steadily, so slip = c (t - t0)^3 / 6: its cube root is a line that leaves 0 at t0.
/// With c = g rate / cos theta0 the line rises by cbrt(g / (6 rate^2 cos theta0)) per radian that
/// the plate turns. A body that creeps from the start, or is shaken loose, slips otherwise.
/// Proved by TiltFriction.IsTheAngleOfSliding in tests/dem/experiment_tilt_test.cpp.
/// @throws NoMeasurement  it slips otherwise.
double onset_deg(const Slide& slide, double begin_deg, double rate_deg_s);

/// Where a plate stops to turn.
inline constexpr double kSteepest_deg = 89;
/// The onset comes out within .01 degrees up to here, and half a degree low at 50.
inline constexpr double kFastest_deg_s = 10;

/// Turned by an angle about y: what pointed along +x points down the slope.
Quaternion slope(double angle_deg);

/// Where a grain is in the frame of a wall, and how it is turned there.
Vector on_plate(const Simulation& simulation, int wall, int grain);
Quaternion turn_on_plate(const Simulation& simulation, int wall, int grain);

/// `count` grains that touch, all turned the same way, as one rigid grain.
///
/// They stand in a row along their middle axis: in lying_pose() the row lies along x. Mass and
/// inertia are those of the grains' own surfaces, by the parallel axis theorem (Goldstein, Poole,
/// Safko 2002, Classical Mechanics, sec. 5.3): a row along one principal axis keeps the axes, and
/// adds the mean square distance from its middle to the other two. Proved by Bonded.* in
/// tests/dem/experiment_bonded_test.cpp. The surface is left empty.
ClumpShape bonded_shape(const ClumpShape& grain, int count);

}  // namespace repose::dem
