#include "dem/verify/trial.h"

#include <cmath>
#include <utility>

#include "dem/engine/time_step.h"

namespace repose::dem {

Trial::Trial(const VerifyCase& which, double timestep_fraction)
    : name_(which.name), source_(which.source), timestep_share_(timestep_fraction) {}

Simulation Trial::simulate(SimulationSetup setup, double speed_m_s) {
  setup.timestep_s = timestep_share_ * accurate_timestep_s(setup, speed_m_s);
  timestep_s_ = setup.timestep_s;
  return Simulation(std::move(setup));
}

void Trial::expect(const std::string& quantity, double expected, double measured,
                   double tolerance) {
  results_.push_back({.name = name_,
                      .quantity = quantity,
                      .source = source_,
                      .expected = expected,
                      .measured = measured,
                      .tolerance = tolerance,
                      .timestep_s = timestep_s_,
                      .holds = std::abs(measured - expected) <= tolerance});
}

}  // namespace repose::dem
