// Made-up materials are measured on a made-up bench, calibrated, and compared with what they are:
// do the 95 % intervals hold the truth, and how narrow are they?

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "calibrate/fit/chance.h"
#include "calibrate/fit/joint_fit.h"
#include "tests/calibrate/fake_bench.h"

namespace {

using repose::calibrate::FittedParameter;
using repose::calibrate::JointFit;
using repose::calibrate::Parameter;
using repose::calibrate::Problem;
using repose::calibrate::Verdict;
namespace fake = repose::calibrate::fake;

/// How one parameter came back over all materials.
struct Tally {
  int determined = 0;
  int one_sided = 0;
  int undetermined = 0;
  int held = 0;             ///< truths inside the interval
  int held_determined = 0;  ///< of the determined ones
  std::vector<double> widths;

  void add(const FittedParameter& fitted, double truth, double range) {
    const bool holds = truth >= fitted.interval.low && truth <= fitted.interval.high;
    held += holds;
    held_determined += holds && fitted.verdict == Verdict::determined;
    determined += fitted.verdict == Verdict::determined;
    one_sided += fitted.verdict == Verdict::one_sided;
    undetermined += fitted.verdict == Verdict::undetermined;
    widths.push_back((fitted.interval.high - fitted.interval.low) / range);
  }
};

/// Anywhere but the outer tenths of the bounds; grains that do not rebound at all, below .2 of
/// restitution's, would give readings without scatter.
std::vector<double> made_up_material(repose::calibrate::Chance& chance) {
  std::vector<double> truth;
  for (const Parameter& parameter : fake::parameters()) {
    const double least = truth.empty() ? .2 : .1;
    const double share = least + (.9 - least) * chance.uniform();
    truth.push_back(parameter.min + share * (parameter.max - parameter.min));
  }
  return truth;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void print(const std::vector<Tally>& tallies, int materials) {
  fmt::print("{:<44} {:>6} {:>6} {:>6} {:>7} {:>11} {:>7}\n", "parameter", "determ", "1-side",
             "undet", "held %", "determ held", "width %");
  int held = 0;
  int determined = 0;
  int held_determined = 0;
  for (std::size_t j = 0; j < tallies.size(); ++j) {
    const Tally& tally = tallies[j];
    fmt::print("{:<44} {:>6} {:>6} {:>6} {:>7.1f} {:>11} {:>7.1f}\n", fake::parameters()[j].name,
               tally.determined, tally.one_sided, tally.undetermined, 100. * tally.held / materials,
               fmt::format("{}/{}", tally.held_determined, tally.determined),
               100 * median(tally.widths));
    held += tally.held;
    determined += tally.determined;
    held_determined += tally.held_determined;
  }
  fmt::print("intervals that hold the truth: all {:.1f} %, of determined ones {:.1f} %\n",
             100. * held / (materials * static_cast<double>(tallies.size())),
             determined > 0 ? 100. * held_determined / determined : 0);
}

void recover(int materials, double budget_s, std::uint64_t seed, bool verbose) {
  repose::calibrate::Chance chance(seed);
  std::vector<Tally> tallies(fake::parameters().size());
  for (int m = 0; m < materials; ++m) {
    const std::vector<double> truth = made_up_material(chance);
    Problem problem = fake::problem(truth, seed + static_cast<unsigned>(m));
    problem.settings.budget_s = budget_s;
    const JointFit fit = fit_jointly(problem, fake::study(problem));
    for (std::size_t j = 0; j < truth.size(); ++j) {
      const FittedParameter& fitted = fit.parameters[j];
      const double range = problem.parameters[j].max - problem.parameters[j].min;
      tallies[j].add(fitted, truth[j], range);
      if (verbose) {
        fmt::print(
            "{:>3} {:<44} truth {:.4f} found {:.4f} [{:.4f}, {:.4f}] {}\n", m, fitted.name,
            truth[j], fitted.value, fitted.interval.low, fitted.interval.high,
            truth[j] < fitted.interval.low || truth[j] > fitted.interval.high ? "MISSED" : "");
      }
    }
  }
  print(tallies, materials);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Coverage of the intervals over made-up materials"};
  int materials = 24;
  double budget_s = 1200;
  std::uint64_t seed = 1;
  bool verbose = false;
  app.add_option("--materials", materials, "how many")->check(CLI::PositiveNumber);
  app.add_option("--budget-s", budget_s, "seconds of simulation for each, made up too");
  app.add_option("--seed", seed);
  app.add_flag("--verbose", verbose, "every parameter of every material");
  CLI11_PARSE(app, argc, argv);
  try {
    recover(materials, budget_s, seed, verbose);
  } catch (const std::exception& error) {
    fmt::print(stderr, "recovery: {}\n", error.what());
    return 1;
  }
  return 0;
}
