#pragma once

namespace repose::dem {

/// The damping factor that gives a Hertz contact the wanted coefficient of restitution when it may
/// never pull.
///
/// Force: F = max(0, k delta^(3/2) + factor sqrt(S m*) delta'), S = 3/2 k delta^(1/2). Scaled by
/// impact speed and duration the collision x'' = -max(0, x^(3/2) + factor sqrt(3/2) x^(1/4) x'),
/// x(0) = 0, x'(0) = 1 depends on the factor alone (Tsuji et al. 1992, Powder Technology 71, eq.
/// 16); it ends when the force does (Schwager and Poeschel 2007, Granular Matter 9, sec. 4). The
/// textbook factor -2 sqrt(5/6) ln e / sqrt(pi^2 + ln^2 e), kept with a force that is cut off,
/// returns .25 for .1.
///
/// @param restitution  .01 ... 1
/// Proved by Restitution.* in tests/dem/restitution_test.cpp.
double damping_factor(double restitution);

/// 2 sqrt(5/6) beta, beta = -ln e / sqrt(pi^2 + ln^2 e): the factor of a damper that may pull, in
/// common use for tangential damping (EDEM 2022 documentation, "Hertz-Mindlin (no slip)").
double textbook_damping_factor(double restitution);

/// The coefficient of restitution that a damping factor (>= 0) gives: the inverse.
double restitution_of(double damping_factor);

}  // namespace repose::dem
