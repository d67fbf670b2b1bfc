#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/problem.h"
#include "calibrate/fit/solution.h"

namespace repose::calibrate {

/// What would determine each parameter that the data leave open; in the problem's order.
class Advisor {
 public:
  /// Learns the readings that a bench could have given and that were not measured.
  Advisor(const Problem& problem, const std::vector<Run>& runs, const Solution& solution);

  /// One sentence or two about one parameter.
  std::string advice(std::size_t parameter) const;

 private:
  /// A reading not measured, at every plausible set.
  struct Unmeasured {
    std::string experiment;
    std::string reading;
    std::vector<double> readings;
    double noise2 = 0;  ///< of a measured mean of ten and of the surrogate, mean over the sets
  };
  double fraction_explained(const Unmeasured& unmeasured, std::size_t parameter) const;

  /// Some observable depends on it visibly, and its surrogate is the weakest link.
  bool more_runs_would_help(std::size_t parameter) const;

  const Problem& problem_;
  const Solution& solution_;
  std::vector<Unmeasured> unmeasured_;
};

}  // namespace repose::calibrate
