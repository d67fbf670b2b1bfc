// Made-up materials are measured on a made-up bench, calibrated, and compared with what they are:
// do the 95 % intervals hold the truth, and how narrow are they?

#include <exception>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/random.h"
#include "tests/bench/recovery_tally.h"
#include "tests/bench/simulated_recovery.h"
#include "tests/calibrate/fake_simulator.h"

namespace {

namespace fake = repose::calibrate::fake;
using repose::bench::SimulatedRecovery;

/// On a made-up bench and with made-up simulations, whose truth is known exactly: minutes.
void recover(const SimulatedRecovery& plan) {
  repose::calibrate::Random random(plan.seed);
  repose::bench::RecoveryTally tally(fake::parameters());
  for (int m = 0; m < plan.materials; ++m) {
    const std::vector<double> truth = repose::bench::made_up_material(fake::parameters(), random);
    repose::calibrate::Problem problem = fake::problem(truth, plan.seed + static_cast<unsigned>(m));
    problem.settings.budget_s = plan.budget_s;
    tally.add(fit_jointly(problem, fake::study(problem)), truth, plan.verbose);
  }
  tally.print();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Coverage of the intervals over made-up materials"};
  SimulatedRecovery plan;
  plan.folder = "recovery";
  std::string study;
  double budget_s = 0;
  app.add_option("--materials", plan.materials, "how many")->check(CLI::PositiveNumber);
  app.add_option("--budget-s", budget_s, "seconds of simulation for each");
  app.add_option("--seed", plan.seed);
  app.add_option("--simulated", study,
                 "a study file: measure and calibrate with real simulations of it");
  app.add_option("--experiments", plan.experiments, "with --simulated: make only these")
      ->delimiter(',');
  app.add_option("--out", plan.folder, "keeps the runs of --simulated");
  app.add_flag("--verbose", plan.verbose, "every parameter of every material");
  CLI11_PARSE(app, argc, argv);
  try {
    constexpr double kMadeUp_s = 1200, kSimulated_s = 150;
    plan.study = study;
    plan.budget_s = budget_s > 0 ? budget_s : study.empty() ? kMadeUp_s : kSimulated_s;
    if (study.empty()) {
      recover(plan);
    } else {
      recover_simulated(plan);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "recovery: {}\n", error.what());
    return 1;
  }
  return 0;
}
