#include "tests/bench/recovery_tally.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/core.h>

#include "calibrate/result/result.h"
#include "tests/bench/median.h"

namespace repose::bench {
namespace {

using calibrate::AgreementVerdict;
using calibrate::FittedParameter;
using calibrate::Parameter;
using calibrate::Verdict;

constexpr double kLevel = .05;

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
    ++row.verdicts[fitted.verdict];
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

void RecoveryTally::add(const calibrate::StudyOutcome& outcome, const std::vector<double>& truth,
                        bool verbose) {
  add(outcome.fit, truth, verbose);
  ++agreements_[outcome.best.verdict];
  for (const calibrate::Agreement& one : outcome.best.observables) {
    if (!verbose) continue;
    fmt::print("    {:<44} measured {:.4g} +- {:.2g} simulated {:.4g} +- {:.2g} chance {:.3f}\n",
               one.observable, one.measured, one.measured_uncertainty, one.simulated,
               one.simulated_uncertainty, one.chance);
  }
  for (const calibrate::Prediction& prediction : outcome.predictions) {
    HeldOut& held_out = held_out_[prediction.name];
    ++held_out.predictions;
    held_out.held += prediction.chance >= kLevel;
    ++held_out.verdicts[prediction.verdict];
    if (verbose) {
      fmt::print("    {:<44} measured {:.4g} predicted {:.4g} [{:.4g}, {:.4g}] chance {:.3f}\n",
                 prediction.name, prediction.measured, prediction.predicted,
                 prediction.interval.low, prediction.interval.high, prediction.chance);
    }
  }
}

void RecoveryTally::print_verdicts() const {
  const auto print = [](const std::map<AgreementVerdict, int>& verdicts) {
    for (const auto& [verdict, name] : calibrate::kAgreementNames) {
      const auto found = verdicts.find(verdict);
      fmt::print(" {} {}", name, found == verdicts.end() ? 0 : found->second);
    }
    fmt::print("\n");
  };
  if (!agreements_.empty()) {
    fmt::print("bench and simulation:");
    print(agreements_);
  }
  for (const auto& [name, held_out] : held_out_) {
    fmt::print("{} held out: within chance {} of {},", name, held_out.held, held_out.predictions);
    print(held_out.verdicts);
  }
}

void RecoveryTally::print() const {
  fmt::print("{:<44}", "parameter");
  for (const auto& [verdict, name] : calibrate::kVerdictNames) fmt::print(" {:>12}", name);
  fmt::print(" {:>7} {:>11} {:>7} {:>10} {:>9}\n", "held %", "determ held", "width %", "foreseen %",
             "log ratio");
  int held = 0;
  int determined = 0;
  int held_determined = 0;
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const Row& row = rows_[j];
    const auto count = [&](Verdict verdict) {
      const auto found = row.verdicts.find(verdict);
      return found == row.verdicts.end() ? 0 : found->second;
    };
    const int own = count(Verdict::determined);
    fmt::print("{:<44}", parameters_[j].name);
    for (const auto& [verdict, name] : calibrate::kVerdictNames) {
      fmt::print(" {:>12}", count(verdict));
    }
    fmt::print(" {:>7.1f} {:>11} {:>7.1f}", 100. * row.held / materials_,
               fmt::format("{}/{}", row.held_determined, own), 100 * median(row.widths));
    if (!foreseen_.empty()) {
      fmt::print(" {:>10.1f} {:>9.2f}", 100 * foreseen_[j],
                 std::log(median(row.widths) / foreseen_[j]));
    }
    fmt::print("\n");
    held += row.held;
    determined += own;
    held_determined += row.held_determined;
  }
  fmt::print("intervals that hold the truth: all {:.1f} %, of determined ones {:.1f} %\n",
             100. * held / (materials_ * static_cast<double>(rows_.size())),
             determined > 0 ? 100. * held_determined / determined : 0);
  print_verdicts();
}

}  // namespace repose::bench
