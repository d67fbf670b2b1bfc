#pragma once

#include "dem/experiment/model_setup.h"
#include "dem/experiment/protocol.h"
#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// Two grains whose strings hang upright: one swings along +x, and is about to touch the other.
struct HangingPair {
  Quaternion swinging = Quaternion::Identity();
  Quaternion hanging = Quaternion::Identity();
  /// From centre to centre, at the same height: a thousandth of a grain's reach before they touch.
  double apart_m = 0;
};

/// In random poses; the next call with the same numbers is the next pair.
HangingPair hanging_pair(const ClumpShape& shape, Random& random);

/// How far the swinging grain has fallen since it was let go, m, and its speed, m/s.
double release_height_m(const PendulumProtocol& protocol);
double swing_speed_m_s(const PendulumProtocol& protocol);

/// How the grains part, in ways of the swinging grain as fractions of its reach: as far it goes
/// until both touch, as far between two looks whether they have parted, and as far at most.
inline constexpr double kPendulumGap = .001;
inline constexpr double kPendulumLook = .05;
inline constexpr double kPendulumLongest = 20;

}  // namespace repose::dem
