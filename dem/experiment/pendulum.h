#pragma once

#include <cstdint>

#include "dem/experiment/experiment.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/vector.h"

namespace repose::dem {

class Random;

/// Two equal grains on strings, side by side: one is drawn aside, released, and strikes the other.
///
/// String length is measured from the hinge to the grain's centre. Value: the angle to which the
/// struck grain swings, degrees, mean over the pairs, each of grains in random poses that meet with
/// their centres at the same height. For equal balls of restitution e, the struck ball rises to ((1
/// + e) / 2)^2 of the other's release height. Readings: "rise_mm" (that height), "height_ratio" and
/// "sd_deg" (scatter of the value between pairs).
struct PendulumProtocol {
  double string_m = .3;
  double release_deg = 30;
  int pairs = 10;
};

Repeat run_pendulum(const Model& model, const PendulumProtocol& protocol, std::uint64_t seed,
                    const ProgressReport& report = {}, const RunRecord& record = {});

/// Two grains whose strings hang vertically: one swings along +x and is about to touch the other.
struct HangingPair {
  Quaternion swinging = Quaternion::Identity();
  Quaternion hanging = Quaternion::Identity();
  /// From centre to centre, at the same height: a thousandth of a grain's reach before they touch.
  double apart_m = 0;
};

/// In random poses; the next call with the same generator gives the next pair.
HangingPair hanging_pair(const ClumpShape& shape, Random& random);

/// How far the swinging grain has fallen since its release, m, and its speed, m/s.
double release_height_m(const PendulumProtocol& protocol);
double swing_speed_m_s(const PendulumProtocol& protocol);

/// Distances travelled by the swinging grain, as fractions of its reach: until both touch, between
/// two checks whether they have separated, and at most.
inline constexpr double kPendulumGap = .001;
inline constexpr double kPendulumLook = .05;
inline constexpr double kPendulumLongest = 20;

}  // namespace repose::dem
