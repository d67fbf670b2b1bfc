#include "tests/bench/recovery_tally.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/core.h>

#include "tests/bench/median.h"

namespace repose::bench {
namespace {

using calibrate::FittedParameter;
using calibrate::Parameter;
using calibrate::Verdict;

bool holds(const FittedParameter& fitted, double truth) {
  return truth >= fitted.interval.low && truth <= fitted.interval.high;
}

}  // namespace

std::vector<double> made_up_material(const std::vector<Parameter>& parameters,
                                     calibrate::Random& random) {
  std::vector<double> truth;
  for (const Parameter& parameter : parameters) {
    const double least = truth.empty() ? .2 : .1;
    const double fraction = least + (.9 - least) * random.uniform();
    truth.push_back(parameter.min + fraction * (parameter.max - parameter.min));
  }
  return truth;
}

RecoveryTally::RecoveryTally(std::vector<Parameter> parameters)
    : parameters_(std::move(parameters)), rows_(parameters_.size()) {}

void RecoveryTally::add(const calibrate::JointFit& fit, const std::vector<double>& truth,
                        bool verbose) {
  for (std::size_t j = 0; j < truth.size(); ++j) {
    const FittedParameter& fitted = fit.parameters[j];
    const bool is_held = holds(fitted, truth[j]);
    const bool is_determined = fitted.verdict == Verdict::determined;
    Row& row = rows_[j];
    row.held += is_held;
    row.held_determined += is_held && is_determined;
    row.determined += is_determined;
    row.one_sided += fitted.verdict == Verdict::one_sided;
    row.undetermined += fitted.verdict == Verdict::undetermined;
    row.widths.push_back((fitted.interval.high - fitted.interval.low) /
                         (parameters_[j].max - parameters_[j].min));
    if (verbose) {
      fmt::print("{:>3} {:<44} truth {:.4f} found {:.4f} [{:.4f}, {:.4f}] {}\n", materials_,
                 fitted.name, truth[j], fitted.value, fitted.interval.low, fitted.interval.high,
                 is_held ? "" : "MISSED");
    }
  }
  ++materials_;
  std::fflush(stdout);
}

void RecoveryTally::print() const {
  fmt::print("{:<44} {:>6} {:>6} {:>6} {:>7} {:>11} {:>7}\n", "parameter", "determ", "1-side",
             "undet", "held %", "determ held", "width %");
  int held = 0;
  int determined = 0;
  int held_determined = 0;
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const Row& row = rows_[j];
    fmt::print("{:<44} {:>6} {:>6} {:>6} {:>7.1f} {:>11} {:>7.1f}\n", parameters_[j].name,
               row.determined, row.one_sided, row.undetermined, 100. * row.held / materials_,
               fmt::format("{}/{}", row.held_determined, row.determined), 100 * median(row.widths));
    held += row.held;
    determined += row.determined;
    held_determined += row.held_determined;
  }
  fmt::print("intervals that hold the truth: all {:.1f} %, of determined ones {:.1f} %\n",
             100. * held / (materials_ * static_cast<double>(rows_.size())),
             determined > 0 ? 100. * held_determined / determined : 0);
}

}  // namespace repose::bench
