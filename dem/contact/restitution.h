#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "dem/contact/material.h"

namespace repose::dem {

/// The damping factor that gives a Hertz contact without tension the required coefficient of
/// restitution.
///
/// Force: F = max(0, k delta^(3/2) + factor sqrt(S m*) delta'), S = 3/2 k delta^(1/2). Scaled by
/// impact speed and duration the collision x'' = -max(0, x^(3/2) + factor sqrt(3/2) x^(1/4) x'),
/// x(0) = 0, x'(0) = 1 depends on the factor alone (Tsuji et al. 1992, Powder Technology 71, eq.
/// 16); it ends when the force vanishes (Schwager and Poeschel 2007, Granular Matter 9, sec. 4).
/// With such a force, the textbook factor -2 sqrt(5/6) ln e / sqrt(pi^2 + ln^2 e) gives .25 instead
/// of .1.
///
/// @param restitution  .01 ... 1
/// Proved by Restitution.* in tests/dem/restitution_test.cpp.
double damping_factor(double restitution);

/// 2 sqrt(5/6) beta, beta = -ln e / sqrt(pi^2 + ln^2 e): the factor of a damper that may pull,
/// commonly used for tangential damping (EDEM 2022 documentation, "Hertz-Mindlin (no slip)").
double textbook_damping_factor(double restitution);

/// Inverse of damping_factor(): the coefficient of restitution for a damping factor >= 0.
double restitution_of(double damping_factor);

/// Restitution of a central impact at this speed: e0 (v / v0)^-alpha, clamped to .01 ...
/// kMaxRestitutionBySpeed; e0 if the exponent alpha is 0.
double restitution_at(const PairCoefficients& pair, double speed_m_s);

/// The damping factors of a contact whose restitution depends on impact speed.
///
/// Impacts are not distinguished from lasting contacts: damping depends on the contact's own
/// equivalent speed, w^2 = v_n^2 + 2 U / m*, U its elastic energy. An impact begins at w = v and
/// ends at w = e v, and its restitution is as if damped by the e of a speed in between. So the
/// damper at w is that of restitution
///   l(w) = c^(1 + alpha (m - 1/2) / (1 - alpha m) + .095 alpha^2),
///   c    = e0 (w / (v0 sqrt(e0)))^(-alpha / (1 - alpha / 2)),
///   m    = .32 + .2 sqrt(c) - .02 c.
/// c would be the solution if the speed in between were v sqrt(e); it is v e^m. m, from the
/// impact's equation for alpha -> 0, and the last term are fitted: e comes out within .2 % for e
/// from .05 on and alpha up to 1/4 (dem/THEORY.md, "Restitution that depends on the speed"). Proved
/// by RestitutionBySpeed.* and, in `repose verify`, "restitution by speed".
class SpeedDamping {
 public:
  struct Factors {
    double normal = 0;      ///< damping_factor()
    double tangential = 0;  ///< textbook_damping_factor()
  };

  SpeedDamping() = default;
  explicit SpeedDamping(const PairCoefficients& pair);

  /// Restitution is the same at all speeds; no factors are stored here.
  bool is_constant() const { return nodes_.empty(); }

  /// @param speed2  w^2, m^2/s^2
  Factors at(double speed2) const {
    // Nodes lie at 1, 1 1/4, 1 1/2, 1 3/4 times powers of 2: a double's leading bits are the node's
    // number.
    const auto bits = std::bit_cast<std::uint64_t>(speed2);
    const std::uint64_t number = bits >> kFractionBits;
    if (number < kFirst) return nodes_.front();
    if (number - kFirst + 1 >= nodes_.size()) return nodes_.back();
    constexpr std::uint64_t kOne = std::uint64_t{1} << kFractionBits;
    const double part = static_cast<double>(bits & (kOne - 1)) / static_cast<double>(kOne);
    const Factors& below = nodes_[number - kFirst];
    const Factors& above = nodes_[number - kFirst + 1];
    return {below.normal + part * (above.normal - below.normal),
            below.tangential + part * (above.tangential - below.tangential)};
  }

 private:
  static constexpr int kFractionBits = 50;  ///< of 52
  static constexpr std::uint64_t kFirst = std::bit_cast<std::uint64_t>(0x1p-60) >> kFractionBits;
  static constexpr std::uint64_t kLast = std::bit_cast<std::uint64_t>(0x1p20) >> kFractionBits;

  std::vector<Factors> nodes_;
};

}  // namespace repose::dem
