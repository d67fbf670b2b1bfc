#include "tests/bench/simulated_recovery.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/core.h>

#include "base/input_error.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/rounds.h"
#include "calibrate/plan/foresight.h"
#include "calibrate/study/executor.h"
#include "calibrate/study/job_runner.h"
#include "calibrate/study/study_run.h"
#include "dem/experiment/experiment_table.h"
#include "dem/study/grain_source.h"
#include "tests/bench/recovery_tally.h"

namespace repose::bench {
namespace {

constexpr int kReadings = 8, kSingleReadings = 30;
constexpr double kReading_deg = .5, kReadingFraction = .03;
constexpr std::uint64_t kBenchSeeds = 1'000'000;       // no study uses these
constexpr std::uint64_t kStudySeeds = 10'000'000'000;  // a study uses fewer

/// The study without the experiments that are not run.
dem::Study read_plan(const SimulatedRecovery& plan, const std::vector<std::string>& more) {
  std::vector<std::string> settings = plan.settings;
  settings.insert(settings.end(), more.begin(), more.end());
  dem::Study study = dem::read_study(plan.study, settings);
  if (plan.experiments.empty()) return study;
  std::erase_if(study.experiments, [&](const auto& described) {
    return std::ranges::count(plan.experiments, dem::name_of(described.first)) == 0;
  });
  return study;
}

/// Settings that turn the study into a bench: single readings of single grains, at their real
/// stiffness, and the properties that the study does not know.
std::vector<std::string> bench_settings(const SimulatedRecovery& plan, const dem::Study& study) {
  std::vector<std::string> settings = plan.bench_settings;
  for (const auto& [experiment, described] : study.experiments) {
    const std::string name = dem::name_of(experiment);
    if (described.stiffness_factor != 1) {
      settings.push_back(fmt::format("experiment.{}.stiffness_factor=1", name));
    }
    if (experiment->readings_per_run == nullptr) continue;
    const char* grains = name == "pendulum"         ? "pairs"
                         : name.starts_with("drop") ? "grains"
                                                    : "places";
    settings.push_back(fmt::format("experiment.{}.{}=1", name, grains));
  }
  return settings;
}

/// A dummy measurement for every experiment makes the study list its free parameters.
calibrate::Problem problem_in(dem::Study study, const dem::ClumpFile& grain,
                              const calibrate::Budget& budget) {
  for (auto& [experiment, described] : study.experiments) described.measured.mean = 1;
  return calibrate::problem_of(study, grain, budget).problem;
}

/// A study, its grain, and where its runs are stored.
struct Calibrated {
  const dem::Study& study;
  const dem::ClumpFile& grain;
  const calibrate::RunStore& folder;
};

int cores() { return static_cast<int>(std::thread::hardware_concurrency()); }

/// The interval widths that `repose plan` predicts for this many readings of each experiment, as
/// fractions of the bounds' distance, before anything is measured. It is given this bench's own
/// scatter, apart from its grains', which is less than it assumes for a person's.
std::vector<double> foreseen_widths(const Calibrated& with, calibrate::Problem problem,
                                    int readings) {
  for (calibrate::Experiment& experiment : problem.experiments) {
    experiment.usual_scatter = kReadingFraction;
  }
  calibrate::StudySimulator simulator(with.study, with.grain, problem.parameters);
  simulator.store_in(with.folder);
  calibrate::ThreadExecutor executor(simulator, cores());
  const std::atomic<bool> never = false;
  const calibrate::StudyContext context{simulator, with.folder, executor, never};
  calibrate::JobRunner runner(problem, context);
  const std::vector<calibrate::Run> runs = runner.get("plan", first_round(problem)).value();
  problem.observables.clear();
  const calibrate::Foresight foresight(problem, runs, readings);
  std::vector<std::size_t> all(foresight.prospects().size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return foresight.with(all).widths;
}

class Material {
 public:
  /// `bench`: the study as measured, see bench_settings.
  Material(const Calibrated& with, const Calibrated& bench, std::optional<int> count,
           const std::vector<calibrate::Parameter>& sought, std::vector<double> truth,
           std::uint64_t number)
      : study_(with.study),
        grain_(with.grain),
        folder_(with.folder),
        simulator_(with.study, with.grain, sought),
        bench_(bench.study, bench.grain, sought),
        count_(count),
        truth_(std::move(truth)),
        number_(number),
        random_(number) {
    // With one study's seeds, all materials would be checked in the same few poses.
    study_.seed = kStudySeeds * (number_ + 1);
    simulator_.store_in(folder_);
    bench_.store_in(bench.folder);
  }

  calibrate::StudyOutcome calibrated(const calibrate::Budget& budget) {
    for (auto& [experiment, described] : study_.experiments) {
      described.measured.values = readings(*experiment);
    }
    const calibrate::Problem problem = calibrate::problem_of(study_, grain_, budget).problem;
    calibrate::ThreadExecutor executor(simulator_, cores());
    return calibrate::run_study(problem, budget, {simulator_, folder_, executor, never_}).value();
  }

 private:
  /// The readings of a bench, without those that failed.
  std::vector<double> readings(const dem::ExperimentEntry& experiment) {
    std::vector<double> values;
    const int wanted =
        count_.value_or(experiment.readings_per_run == nullptr ? kReadings : kSingleReadings);
    for (int i = 0; i < wanted; ++i) {
      const calibrate::Run run =
          simulated({std::string(experiment.name), truth_,
                     kBenchSeeds * (number_ + 1) + static_cast<std::uint64_t>(i)});
      const double noise = random_.normal();
      if (!run.failure.empty()) continue;
      const double value = run.readings.at("value");
      const bool is_angle = experiment.unit == "deg";
      values.push_back(std::max(
          0., is_angle ? value + kReading_deg * noise : value * (1 + kReadingFraction * noise)));
    }
    return values;
  }

  calibrate::Run simulated(const calibrate::Job& job) {
    return run_of(job, bench_.simulate(job, never_));
  }

  dem::Study study_;
  const dem::ClumpFile& grain_;
  const calibrate::RunStore& folder_;
  calibrate::StudySimulator simulator_, bench_;
  std::optional<int> count_;  ///< readings of each experiment
  std::vector<double> truth_;
  std::uint64_t number_;
  calibrate::Random random_;
  std::atomic<bool> never_ = false;
};

}  // namespace

void recover_simulated(const SimulatedRecovery& plan) {
  const dem::Study study = read_plan(plan, {});
  const dem::Study bench = read_plan(plan, bench_settings(plan, study));
  const dem::ClumpFile grain = dem::build_grain(study.grain);
  const dem::ClumpFile bench_grain = dem::build_grain(bench.grain);
  calibrate::Budget budget = calibrate::budget_named("quick");
  budget.settings.budget_s = plan.budget_s;
  budget.family_sets = 0;
  const calibrate::Problem problem = problem_in(study, grain, budget);
  const calibrate::RunStore folder(plan.folder);
  const Calibrated calibrated{study, grain, folder};
  const Calibrated measured{bench, bench_grain, folder};
  RecoveryTally tally(problem.parameters);
  if (plan.readings) tally.foresee(foreseen_widths(calibrated, problem, *plan.readings));
  calibrate::Random random(plan.seed);
  for (int m = 0; m < plan.materials; ++m) {
    const std::vector<double> truth = made_up_material(problem.parameters, random);
    Material material(calibrated, measured, plan.readings, problem.parameters, truth,
                      plan.seed + static_cast<std::uint64_t>(m));
    try {
      tally.add(material.calibrated(budget), truth, plan.verbose);
    } catch (const base::InputError& refused) {
      fmt::print("material {} cannot be measured: {}\n", m, refused.what());
    }
  }
  tally.print();
}

}  // namespace repose::bench
