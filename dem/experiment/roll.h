#pragma once

#include <cstdint>

#include "dem/engine/simulation.h"
#include "dem/experiment/experiment.h"
#include "dem/vector.h"

namespace repose::dem {

class Random;

/// One grain let go on an incline that ends on a flat plate.
///
/// It lies on the incline, its long axis across the slope but for a turn, and otherwise at random.
/// Value: how far along the flat its centroid lies from the foot once it is at rest, mm. A grain
/// that stays on the incline is released again, up to ten times, as at a bench; then it counts as
/// 0, which is also what the distance of a ball goes to as its rolling friction nears the slope
/// above which it stays. Readings: "lateral_mm" (aside), "stopped_on_incline" (0 or 1), "releases",
/// "hop_mm" (how high its lowest point rose above the flat), "time_s". Throws NoMeasurement for a
/// grain that does not stop.
struct RollProtocol {
  double incline_deg = 20;
  double release_m = .15;        ///< from the foot of the incline, along it
  double release_turn_deg = 10;  ///< of the long axis from lying across the slope, at most
};

Repeat run_roll(const Model& model, const RollProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});

/// The incline of a roll test: its foot is the y axis, and down it goes +x.
struct Incline {
  Quaternion orientation = Quaternion::Identity();  ///< x down the slope, z away from it
  Vector down = Vector::UnitX();
  Vector normal = Vector::UnitZ();
};

Incline incline_of(const RollProtocol& protocol);

/// How often a grain that stays on the incline is released again, the first time included. A ball
/// lies alike however it is put down.
int most_releases(const ClumpShape& shape);

/// Lying on the incline, its long axis across the slope but for the protocol's turn to either side;
/// which end points to the left, the turn and the pose about the long axis are random. The next
/// call with the same numbers is the next release.
Grain released(const ClumpShape& shape, const RollProtocol& protocol, Random& random);

}  // namespace repose::dem
