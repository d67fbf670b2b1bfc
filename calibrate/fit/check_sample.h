#pragma once

#include <limits>
#include <string>
#include <vector>

#include "calibrate/fit/agreement.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/verification.h"

// Internal: what the runs of a check gave.
namespace repose::calibrate {

/// Of a test, before it is shared between its observables.
inline constexpr double kLevel = .05;
/// What is not known.
inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The readings of one observable in the fresh runs of one set of parameters.
struct CheckSample {
  std::vector<double> readings;
  int failed = 0;
  bool is_coarse = false;  ///< of coarse runs, which have a scatter of their own

  int count() const { return static_cast<int>(readings.size()); }
  double mean() const;
  double sd() const;  ///< of single readings; NaN from one
};

/// Of runs with these inputs.
CheckSample check_sample(const Problem& problem, const std::vector<double>& values,
                         const Observable& observable, const std::vector<Run>& runs,
                         const AssumedInputs& inputs = {});

/// How much a single run scatters, and by how many runs that is known.
struct RunScatter {
  double sd = 0;
  int df = 1;
};

/// The larger of what the sample shows and, where there is a fit, of what all runs of its kind
/// show: a handful that happens to agree is not trusted over them. NaN from one run.
RunScatter scatter_of(const CheckSample& sample, const JointFit* fit, std::size_t observable);

/// With the uncertainty that this scatter gives it. NaN without a reading, its uncertainty from
/// one.
UncertainMean mean_of(const CheckSample& sample, bool is_stochastic, const JointFit* fit,
                      std::size_t observable);

}  // namespace repose::calibrate
