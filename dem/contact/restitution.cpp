#include "dem/contact/restitution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <unordered_map>

#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint.hpp>

#include "base/input_error.h"

namespace repose::dem {

namespace {

using State = std::array<double, 2>;  // overlap, its rate; scaled

double force(const State& state, double factor) {
  const double root = std::sqrt(std::max(state[0], 0.0));
  return root * state[0] + factor * std::sqrt(1.5 * root) * state[1];
}

double solved_damping_factor(double restitution) {
  if (!(restitution >= .01 && restitution <= 1)) {
    throw base::InputError({.subject = "restitution",
                            .value = "is " + std::to_string(restitution),
                            .rule = ".01 to 1",
                            .fix = "give the speed ratio of a central impact."});
  }
  if (restitution == 1) return 0;
  const auto excess = [restitution](double factor) { return restitution_of(factor) - restitution; };
  std::uintmax_t rounds = 60;
  const auto bracket = boost::math::tools::toms748_solve(
      excess, 0.0, 20.0, boost::math::tools::eps_tolerance<double>(40), rounds);
  return (bracket.first + bracket.second) / 2;
}

}  // namespace

double restitution_of(double factor) {
  namespace odeint = boost::numeric::odeint;
  // Steps must resolve the start, where the overlap's quarter power has an infinite slope.
  constexpr double kStep = 1e-3;
  const auto motion = [factor](const State& state, State& rate, double /*time*/) {
    rate = {state[1], -force(state, factor)};
  };
  odeint::runge_kutta4<State> stepper;
  State state = {0, 1};
  State before = state;
  double time = 0;
  for (; state[1] > 0 || force(state, factor) > 0; time += kStep) {
    before = state;
    stepper.do_step(motion, state, time, kStep);
  }
  // The force has crossed zero within the last step: the speed there, by interpolation.
  const double from = force(before, factor);
  const double to = force(state, factor);
  const double part = from > to ? from / (from - to) : 1;
  return -(before[1] + part * (state[1] - before[1]));
}

double textbook_damping_factor(double restitution) {
  const double log = std::log(restitution);
  return -2 * std::sqrt(5.0 / 6) * log / std::hypot(std::numbers::pi, log);
}

double damping_factor(double restitution) {
  // Every run builds a contact table, mostly from coefficients already seen.
  thread_local std::unordered_map<double, double> known;
  const auto found = known.find(restitution);
  if (found != known.end()) return found->second;
  return known[restitution] = solved_damping_factor(restitution);
}

namespace {

/// damping_factor() for any restitution without solving each time: its ratio to the textbook factor
/// varies slowly with -ln e and is interpolated.
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
  return std::clamp(restitution, kMinRestitution, kMaxRestitutionBySpeed);
}

/// l(w) in the comment of SpeedDamping.
double local_restitution(const PairCoefficients& pair, double equivalent_speed_m_s) {
  const double alpha = pair.restitution_exponent;
  const double middle_m_s = pair.restitution_speed_m_s * std::sqrt(pair.restitution);
  const double plain =
      pair.restitution * std::pow(equivalent_speed_m_s / middle_m_s, -alpha / (1 - alpha / 2));
  if (plain >= 1) return kMaxRestitutionBySpeed;
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
