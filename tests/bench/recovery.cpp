// Synthetic materials are measured on a synthetic bench, calibrated, and compared with the truth:
// do the 95 % intervals contain it, and how narrow are they? By simulations, or by tables of runs
// that are requested from a synthetic program round by round.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/verification.h"
#include "calibrate/result/result.h"
#include "calibrate/runs/next_runs.h"
#include "calibrate/runs/predicted_readings.h"
#include "calibrate/runs/table_fit.h"
#include "calibrate/runs/table_runs.h"
#include "calibrate/runs/table_study.h"
#include "calibrate/study/study_budget.h"
#include "tests/bench/benches.h"
#include "tests/bench/median.h"
#include "tests/bench/recovery_tally.h"
#include "tests/bench/simulated_recovery.h"
#include "tests/calibrate/fake_simulator.h"
#include "tests/support/temporary_folder.h"

namespace repose::bench {
namespace {

namespace fake = calibrate::fake;

/// As in a study: rounds, then checks with full runs.
calibrate::JointFit checked_fit(const calibrate::Problem& problem) {
  fake::Runs runs = fake::study(problem);
  calibrate::JointFit fit = fit_jointly(problem, runs);
  calibrate::Budget budget = calibrate::budget_named("quick");
  budget.settings = problem.settings;
  budget = calibrate::with_affordable_checks(budget, problem);
  for (int set = 0; set < budget.check_rounds; ++set) {
    const bool is_last = set + 1 == budget.check_rounds;
    const int repeats = is_last ? budget.verification_repeats : budget.round_repeats;
    std::vector<double> values;
    for (const auto& parameter : fit.parameters) values.push_back(parameter.value);
    for (const calibrate::Job& job : verification_jobs(problem, values, repeats, set)) {
      runs.push_back(fake::run(job));
    }
    fit = fit_jointly(problem, runs);
  }
  return fit;
}

/// With a synthetic bench and synthetic simulations, whose truth is known exactly: takes minutes.
void recover(const SimulatedRecovery& plan) {
  calibrate::Random random(plan.seed);
  RecoveryTally tally(fake::parameters());
  for (int m = 0; m < plan.materials; ++m) {
    const std::vector<double> truth = made_up_material(fake::parameters(), random);
    calibrate::Problem problem = fake::problem(truth, plan.seed + static_cast<unsigned>(m));
    problem.settings.budget_s = plan.budget_s;
    if (plan.heap_s) fake::experiment_of(problem, "heap").run_s = *plan.heap_s;
    if (plan.coarse_size) fake::coarsen(problem, *plan.coarse_size);
    // Without coarse runs checks would say little that the rounds do not.
    tally.add(plan.coarse_size ? checked_fit(problem) : fit_jointly(problem, fake::study(problem)),
              truth, plan.verbose);
  }
  tally.print();
}

/// A reading of a synthetic program: both saturate with friction, unlike anything the fit assumes,
/// hardly depend on restitution, and scatter from seed to seed.
struct MadeUpReading {
  const char* name;
  double (*expected)(const std::vector<double>& values);
  double run_sd;
  double bench_sd;  ///< of single readings
  int bench_n;
};

double made_up_angle(const std::vector<double>& values) {
  const double sliding = 1 - std::exp(-values[0] / .35), rolling = 1 - std::exp(-values[1] / .15);
  return 8 + 30 * sliding * (.25 + .9 * rolling) + .1 * (1 - values[2]);
}

double made_up_density(const std::vector<double>& values) {
  return 900 - 130 * std::sqrt(values[0]) - 40 * values[1] / (values[1] + .1) + .5 * values[2];
}

constexpr std::array<MadeUpReading, 2> kMadeUpReadings = {
    {{"angle", made_up_angle, .7, 1, 6}, {"density", made_up_density, 4, 6, 5}}};

std::vector<calibrate::Parameter> table_parameters() {
  return {{"sliding", .1, .8, {}}, {"rolling", .01, .3, {}}, {"restitution", .1, .9, {}}};
}

std::string table_study(const std::vector<double>& truth, calibrate::Random& random) {
  std::string text = "[parameter]\n";
  for (const calibrate::Parameter& parameter : table_parameters()) {
    text += fmt::format("{} = {{ min = {}, max = {} }}\n", parameter.name, parameter.min,
                        parameter.max);
  }
  text += "[measured]\n";
  for (const MadeUpReading& reading : kMadeUpReadings) {
    std::string values;
    for (int k = 0; k < reading.bench_n; ++k) {
      values += fmt::format("{}{:.3f}", k == 0 ? "" : ", ",
                            reading.expected(truth) + reading.bench_sd * random.normal());
    }
    text += fmt::format("{} = {{ values = [{}] }}\n", reading.name, values);
  }
  return text;
}

/// A material's study, and the tables of requested and completed runs.
class TableOfMaterial {
 public:
  TableOfMaterial(const std::vector<double>& truth, calibrate::Random& random)
      : random_(random),
        study_(
            calibrate::read_table_study(folder_.write("study.toml", table_study(truth, random)))) {}

  /// Requests runs and makes them until there are `most` or no further ones are worthwhile.
  void run(std::size_t most) {
    constexpr std::size_t kStart = 16, kRound = 8;
    std::size_t made = 0;
    while (made < most) {
      const std::size_t count = std::min(made == 0 ? kStart : kRound, most - made);
      const calibrate::NextRuns next = calibrate::next_runs(study_, table(), count);
      if (next.runs.empty()) return;
      files_.push_back(folder_.write(fmt::format("runs_{}.csv", made), filled_in(next.runs)));
      made += next.runs.size();
    }
  }

  calibrate::TableRuns table() const { return calibrate::read_table_runs(study_, files_); }
  const calibrate::TableStudy& study() const { return study_; }

 private:
  std::string filled_in(const std::vector<calibrate::NextRun>& runs) {
    std::string text = "sliding,rolling,restitution,angle,density\n";
    for (const calibrate::NextRun& run : runs) {
      text += fmt::format("{}", fmt::join(run.values, ","));
      for (const MadeUpReading& reading : kMadeUpReadings) {
        text += fmt::format(",{:.4f}",
                            reading.expected(run.values) + reading.run_sd * random_.normal());
      }
      text += '\n';
    }
    return text;
  }

  calibrate::Random& random_;
  testing::TemporaryFolder folder_;
  calibrate::TableStudy study_;
  std::vector<std::filesystem::path> files_;
};

/// Further runs of the synthetic program at random places: how many lie within the predicted
/// intervals.
int predicted_runs(const calibrate::TableStudy& study, const calibrate::TableRuns& table,
                   const std::vector<std::vector<double>>& places, calibrate::Random& random) {
  const auto predicted =
      calibrate::predicted_readings({calibrate::problem_of(study, table), table.runs}, places);
  int held = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (std::size_t i = 0; i < kMadeUpReadings.size(); ++i) {
      const MadeUpReading& reading = kMadeUpReadings[i];
      const double run = reading.expected(places[k]) + reading.run_sd * random.normal();
      const calibrate::Interval& interval = predicted[k][i].interval;
      held += run >= interval.low && run <= interval.high;
    }
  }
  return held;
}

/// By tables of an external program, requested round by round; the same runs are also fitted like
/// those of a study that repose simulates.
void recover_by_tables(const SimulatedRecovery& plan, std::size_t runs_each) {
  constexpr std::size_t kPlaces = 20;
  calibrate::Random random(plan.seed);
  const std::vector<calibrate::Parameter> parameters = table_parameters();
  RecoveryTally tally(parameters);
  int same = 0, verdicts = 0, held = 0, predicted = 0;
  std::vector<double> runs;
  for (int m = 0; m < plan.materials; ++m) {
    const std::vector<double> truth = made_up_material(parameters, random);
    TableOfMaterial material(truth, random);
    material.run(runs_each);
    const calibrate::TableRuns table = material.table();
    runs.push_back(table.rows);
    const auto result = calibrate::fit_table(material.study(), table);
    const auto& joint = std::get<calibrate::JointResult>(result.found);
    calibrate::JointFit fit;
    fit.parameters.assign(joint.parameters.begin(), joint.parameters.end());
    tally.add(fit, truth, plan.verbose);
    calibrate::Problem problem = calibrate::problem_of(material.study(), table);
    problem.settings = {};
    const calibrate::JointFit own = calibrate::fit_jointly(problem, table.runs);
    for (std::size_t j = 0; j < parameters.size(); ++j) {
      same += own.parameters[j].verdict == fit.parameters[j].verdict;
      ++verdicts;
    }
    std::vector<std::vector<double>> places;
    for (std::size_t k = 0; k < kPlaces; ++k) {
      places.push_back(made_up_material(parameters, random));
    }
    held += predicted_runs(material.study(), table, places, random);
    predicted += static_cast<int>(kPlaces * kMadeUpReadings.size());
  }
  tally.print();
  fmt::print("runs of each: median {:.0f}, at most {}\n", median(runs), runs_each);
  fmt::print("verdicts as by a study of repose's own with the same runs: {} of {}\n", same,
             verdicts);
  fmt::print("further runs within their predicted 95 % intervals: {} of {} ({:.1f} %)\n", held,
             predicted, 100. * held / predicted);
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
  app.add_option("--coarse", plan->coarse_size,
                 "made-up simulations: heaps of grains so many times their size besides")
      ->check(CLI::Range(1.1, 8.));
  app.add_option("--heap-s", plan->heap_s, "made-up simulations: seconds that a full heap takes")
      ->check(CLI::PositiveNumber);
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
  const auto table_runs = std::make_shared<std::size_t>(0);
  app.add_option("--tables", *table_runs,
                 "by tables of a made-up program, so many runs of it for each material")
      ->check(CLI::Range(8, 1000));
  app.add_flag("--verbose", plan->verbose, "every parameter of every material");
  app.callback([plan, table_runs] {
    constexpr double kMadeUp_s = 1200, kSimulated_s = 150;
    const bool is_simulated = !plan->study.empty();
    if (plan->budget_s <= 0) plan->budget_s = is_simulated ? kSimulated_s : kMadeUp_s;
    if (*table_runs > 0) {
      recover_by_tables(*plan, *table_runs);
      return;
    }
    is_simulated ? recover_simulated(*plan) : recover(*plan);
  });
}

}  // namespace repose::bench
