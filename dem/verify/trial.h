#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dem/engine/simulation.h"
#include "dem/verify/verify.h"

namespace repose::dem {

class Trial;

/// A setup with a known outcome.
struct VerifyCase {
  std::string name;
  std::string source;
  std::function<void(Trial&)> run;
};

/// One run of a case: at one fraction of the accepted time step. Collects what comes out.
class Trial {
 public:
  Trial(const VerifyCase& which, double timestep_fraction);

  /// The simulation of a setup, with this trial's share of the longest time step that is accepted
  /// for impacts at up to `speed_m_s`.
  Simulation simulate(SimulationSetup setup, double speed_m_s);

  /// Holds when `measured` is no further than `tolerance` from `expected`.
  void expect(const std::string& quantity, double expected, double measured, double tolerance);

  const std::vector<CaseResult>& results() const { return results_; }

 private:
  std::string name_;
  std::string source_;
  double timestep_share_;
  double timestep_s_ = 0;  ///< of the latest simulation
  std::vector<CaseResult> results_;
};

}  // namespace repose::dem
