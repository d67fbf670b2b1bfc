#pragma once

#include <cstdint>

#include "dem/engine/simulation.h"
#include "dem/experiment/experiment.h"
#include "dem/vector.h"

namespace repose::dem {

class Random;

/// One grain released on an incline that ends on a flat plate.
///
/// It lies on the incline, its long axis across the slope within a random angle, otherwise in a
/// random pose. Value: distance along the flat from the foot to its centroid once at rest, mm. A
/// grain that stays on the incline is released again, as on the bench (most_releases() in all);
/// then it counts as 0, which is also the limit for a ball as its rolling friction approaches the
/// value at which it stays. Readings: "lateral_mm" (sideways), "stopped_on_incline" (0 or 1),
/// "releases", "hop_mm" (how high its lowest point rose above the flat), "time_s". Throws
/// NoMeasurement if the grain does not stop.
struct RollProtocol {
  double incline_deg = 20;
  double release_m = .15;        ///< from the foot of the incline, along it
  double release_turn_deg = 10;  ///< largest angle between long axis and cross-slope direction
};

Repeat run_roll(const Model& model, const RollProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});

/// The incline of a roll test: its foot is the y axis, and it descends along +x.
struct Incline {
  Quaternion orientation = Quaternion::Identity();  ///< x down the slope, z away from it
  Vector down = Vector::UnitX();
  Vector normal = Vector::UnitZ();
};

Incline incline_of(const RollProtocol& protocol);

/// Maximum number of releases of a grain that stays on the incline, including the first; 1 for a
/// ball, which lies the same however it is put down.
int most_releases(const ClumpShape& shape);

/// A grain lying on the incline, its long axis across the slope within the protocol's angle to
/// either side; which end points left, the angle and the rotation about the long axis are random.
/// The next call with the same generator gives the next release.
Grain released(const ClumpShape& shape, const RollProtocol& protocol, Random& random);

}  // namespace repose::dem
