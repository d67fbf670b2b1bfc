// Made-up materials are measured on a made-up bench, calibrated, and compared with what they are:
// do the 95 % intervals hold the truth, and how narrow are they?

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/points.h"
#include "tests/bench/benches.h"
#include "tests/bench/recovery_tally.h"
#include "tests/bench/simulated_recovery.h"
#include "tests/calibrate/fake_simulator.h"

namespace repose::bench {
namespace {

namespace fake = calibrate::fake;

/// On a made-up bench and with made-up simulations, whose truth is known exactly: minutes.
void recover(const SimulatedRecovery& plan) {
  calibrate::Random random(plan.seed);
  RecoveryTally tally(fake::parameters());
  for (int m = 0; m < plan.materials; ++m) {
    const std::vector<double> truth = made_up_material(fake::parameters(), random);
    calibrate::Problem problem = fake::problem(truth, plan.seed + static_cast<unsigned>(m));
    problem.settings.budget_s = plan.budget_s;
    tally.add(fit_jointly(problem, fake::study(problem)), truth, plan.verbose);
  }
  tally.print();
}

}  // namespace

void add_recovery(CLI::App& bench) {
  CLI::App& app =
      *bench.add_subcommand("recovery", "Coverage of the intervals over made-up materials");
  const auto plan = std::make_shared<SimulatedRecovery>();
  plan->folder = "recovery";
  plan->budget_s = 0;
  app.add_option("--materials", plan->materials, "how many")->check(CLI::PositiveNumber);
  app.add_option("--budget-s", plan->budget_s, "seconds of simulation for each");
  app.add_option("--seed", plan->seed);
  app.add_option("--simulated", plan->study,
                 "a study file: measure and calibrate with real simulations of it");
  app.add_option("--experiments", plan->experiments, "with --simulated: make only these")
      ->delimiter(',');
  app.add_option("--set", plan->settings, "with --simulated: KEY=VALUE of the study");
  app.add_option("--bench", plan->bench_settings,
                 "with --simulated: KEY=VALUE that the real grains have and the fit does not know");
  app.add_option("--readings", plan->readings,
                 "with --simulated: of each experiment; widths are held against those foreseen")
      ->check(CLI::Range(2, 1000));
  app.add_option("--out", plan->folder, "keeps the runs of --simulated");
  app.add_flag("--verbose", plan->verbose, "every parameter of every material");
  app.callback([plan] {
    constexpr double kMadeUp_s = 1200, kSimulated_s = 150;
    const bool is_simulated = !plan->study.empty();
    if (plan->budget_s <= 0) plan->budget_s = is_simulated ? kSimulated_s : kMadeUp_s;
    is_simulated ? recover_simulated(*plan) : recover(*plan);
  });
}

}  // namespace repose::bench
