#include "tests/bench/simulated_recovery.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fmt/core.h>

#include "calibrate/fit/random.h"
#include "calibrate/study/study_run.h"
#include "calibrate/study/thread_executor.h"
#include "dem/study/grain_source.h"
#include "tests/bench/recovery_tally.h"

namespace repose::bench {
namespace {

constexpr int kReadings = 8, kSingleReadings = 30;
constexpr double kReading_deg = .5, kReadingFraction = .03;
constexpr std::uint64_t kBenchSeeds = 1'000'000;  // no study uses these

/// The study, less the experiments that are not made.
dem::Study read_plan(const SimulatedRecovery& plan, const std::vector<std::string>& settings) {
  dem::Study study = dem::read_study(plan.study, settings);
  if (plan.experiments.empty()) return study;
  std::erase_if(study.experiments, [&](const auto& described) {
    return std::ranges::count(plan.experiments, dem::name_of(described.first)) == 0;
  });
  return study;
}

/// Settings that make the study a bench: single readings of single grains, as stiff as they are.
std::vector<std::string> bench_settings(const dem::Study& study) {
  std::vector<std::string> settings;
  for (const auto& [experiment, described] : study.experiments) {
    const std::string name = dem::name_of(experiment);
    if (described.stiffness_factor != 1) {
      settings.push_back(fmt::format("experiment.{}.stiffness_factor=1", name));
    }
    if (dem::entry_of(experiment).readings_per_run == nullptr) continue;
    const char* grains = name == "pendulum"         ? "pairs"
                         : name.starts_with("drop") ? "grains"
                                                    : "places";
    settings.push_back(fmt::format("experiment.{}.{}=1", name, grains));
  }
  return settings;
}

/// With something measured everywhere, a study says what is sought.
std::vector<calibrate::Parameter> sought_in(dem::Study study, const dem::ClumpFile& grain,
                                            const calibrate::Budget& budget) {
  for (auto& [experiment, described] : study.experiments) described.measured.mean = 1;
  return calibrate::problem_of(study, grain, budget).problem.parameters;
}

class Material {
 public:
  /// `bench`: the study as it is measured, see bench_settings.
  Material(const dem::Study& study, const dem::Study& bench, const dem::ClumpFile& grain,
           const calibrate::RunFolder& folder, const std::vector<calibrate::Parameter>& sought,
           std::vector<double> truth, std::uint64_t number)
      : study_(study),
        grain_(grain),
        folder_(folder),
        simulator_(study, grain, sought),
        bench_(bench, grain, sought),
        truth_(std::move(truth)),
        number_(number),
        random_(number) {
    simulator_.store_in(folder_);
    bench_.store_in(folder_);
  }

  calibrate::StudyOutcome calibrated(const calibrate::Budget& budget) {
    for (auto& [experiment, described] : study_.experiments) {
      described.measured.values = readings(dem::entry_of(experiment));
    }
    const calibrate::Problem problem = calibrate::problem_of(study_, grain_, budget).problem;
    calibrate::ThreadExecutor executor(simulator_,
                                       static_cast<int>(std::thread::hardware_concurrency()));
    return calibrate::run_study(problem, budget, {simulator_, folder_, executor, never_}).value();
  }

 private:
  /// What a bench would read, less the readings that failed.
  std::vector<double> readings(const dem::ExperimentEntry& experiment) {
    std::vector<double> values;
    const int wanted = experiment.readings_per_run == nullptr ? kReadings : kSingleReadings;
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
    return run_of(bench_.simulate(job, never_));
  }

  dem::Study study_;
  const dem::ClumpFile& grain_;
  const calibrate::RunFolder& folder_;
  calibrate::StudySimulator simulator_, bench_;
  std::vector<double> truth_;
  std::uint64_t number_;
  calibrate::Random random_;
  std::atomic<bool> never_ = false;
};

}  // namespace

void recover_simulated(const SimulatedRecovery& plan) {
  const dem::Study study = read_plan(plan, {});
  const dem::Study bench = read_plan(plan, bench_settings(study));
  const dem::ClumpFile grain = dem::build_grain(study.grain);
  calibrate::Budget budget = calibrate::budget_named("quick");
  budget.settings.budget_s = plan.budget_s;
  budget.family_sets = 0;
  const std::vector<calibrate::Parameter> parameters = sought_in(study, grain, budget);
  const calibrate::RunFolder folder(plan.folder);
  RecoveryTally tally(parameters);
  calibrate::Random random(plan.seed);
  for (int m = 0; m < plan.materials; ++m) {
    const std::vector<double> truth = made_up_material(parameters, random);
    Material material(study, bench, grain, folder, parameters, truth,
                      plan.seed + static_cast<std::uint64_t>(m));
    try {
      tally.add(material.calibrated(budget).fit, truth, plan.verbose);
    } catch (const std::invalid_argument& refused) {
      fmt::print("material {} cannot be measured: {}\n", m, refused.what());
    }
  }
  tally.print();
}

}  // namespace repose::bench
