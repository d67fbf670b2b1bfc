#include "dem/contact/speed_damping.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dem/contact/restitution.h"

namespace repose::dem {
namespace {

/// damping_factor() of any restitution, without solving for each: its ratio to the textbook's
/// factor hardly changes from one -ln e to the next, and is interpolated.
class FactorTable {
 public:
  FactorTable() {
    for (int k = 1; k < kNodes; ++k) {
      const double restitution = std::exp(-k * kStep);
      ratios_.at(static_cast<std::size_t>(k)) =
          damping_factor(restitution) / textbook_damping_factor(restitution);
    }
    ratios_[0] = 2 * ratios_[1] - ratios_[2];
  }

  double factor(double restitution) const {
    const double at = std::min(-std::log(restitution) / kStep, kNodes - 1.000001);
    const auto k = static_cast<std::size_t>(at);
    const double ratio =
        ratios_.at(k) + (at - static_cast<double>(k)) * (ratios_.at(k + 1) - ratios_.at(k));
    return ratio * textbook_damping_factor(restitution);
  }

 private:
  static constexpr int kNodes = 49;
  static constexpr double kStep = 4.6 / (kNodes - 1);  // to e^-4.6 = .01005

  std::array<double, kNodes> ratios_ = {};
};

double kept_in_range(double restitution) {
  return std::clamp(restitution, kLeastRestitution, kMostRestitutionBySpeed);
}

/// l(w) in the comment of SpeedDamping.
double local_restitution(const PairCoefficients& pair, double equivalent_speed_m_s) {
  const double alpha = pair.restitution_exponent;
  const double middle_m_s = pair.restitution_speed_m_s * std::sqrt(pair.restitution);
  const double plain =
      pair.restitution * std::pow(equivalent_speed_m_s / middle_m_s, -alpha / (1 - alpha / 2));
  if (plain >= 1) return kMostRestitutionBySpeed;
  const double m = .32 + .2 * std::sqrt(plain) - .02 * plain;
  constexpr double kOfSquare = .095;
  return kept_in_range(
      std::pow(plain, 1 + alpha * (m - .5) / (1 - alpha * m) + kOfSquare * alpha * alpha));
}

}  // namespace

double restitution_at(const PairCoefficients& pair, double speed_m_s) {
  if (pair.restitution_exponent == 0) return pair.restitution;
  return kept_in_range(pair.restitution * std::pow(speed_m_s / pair.restitution_speed_m_s,
                                                   -pair.restitution_exponent));
}

SpeedDamping::SpeedDamping(const PairCoefficients& pair) {
  if (pair.restitution_exponent == 0) return;
  static const FactorTable factors;
  for (std::uint64_t number = kFirst; number <= kLast; ++number) {
    const double speed = std::sqrt(std::bit_cast<double>(number << kFractionBits));
    const double restitution = local_restitution(pair, speed);
    nodes_.push_back({.normal = factors.factor(restitution),
                      .tangential = textbook_damping_factor(restitution)});
  }
}

}  // namespace repose::dem
