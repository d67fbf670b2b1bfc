#include "dem/contact/restitution.h"

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
  // Steps must resolve the start, where the overlap's quarter power has no slope.
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
  // Every run makes a table of contacts, of coefficients that mostly were asked for before.
  thread_local std::unordered_map<double, double> known;
  const auto found = known.find(restitution);
  if (found != known.end()) return found->second;
  return known[restitution] = solved_damping_factor(restitution);
}

}  // namespace repose::dem
