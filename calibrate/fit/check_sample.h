#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/agreement.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/verification.h"

// Internal: results of the runs of a check.
namespace repose::calibrate {

/// Significance level of a test, before it is divided among its observables.
inline constexpr double kLevel = .05;
/// Unknown value.
inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The readings of one observable in the fresh runs of one set of parameters.
struct CheckSample {
  std::vector<double> readings;
  int failed = 0;
  bool is_coarse = false;  ///< coarse runs, which have a scatter of their own

  int count() const { return static_cast<int>(readings.size()); }
  double mean() const;
  double sd() const;  ///< of single readings; NaN for fewer than two
};

/// Sample of the runs with these inputs; std::nullopt: full runs.
CheckSample check_sample(const Problem& problem, const std::vector<double>& values,
                         const Observable& observable, const std::vector<Run>& runs,
                         const std::optional<AssumedInputs>& inputs = {});

/// How much a single run scatters, and how many degrees of freedom that has.
struct RunScatter {
  double sd = 0;
  int df = 1;
};

/// The larger of the sample's scatter and, if there is a fit, that of all its runs of this kind: a
/// few repeats that happen to agree do not override them. NaN from a single run.
RunScatter scatter_of(const CheckSample& sample, const JointFit* fit, std::size_t observable);

/// With its uncertainty from this scatter. NaN without a reading; the uncertainty is NaN for only
/// one.
UncertainMean mean_of(const CheckSample& sample, bool is_stochastic, const JointFit* fit,
                      std::size_t observable);

}  // namespace repose::calibrate
