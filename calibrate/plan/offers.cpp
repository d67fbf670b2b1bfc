#include "calibrate/plan/offers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include <fmt/format.h>

#include "base/units.h"
#include "calibrate/fit/budget.h"
#include "calibrate/plan/plan.h"
#include "calibrate/start/usual_experiment.h"
#include "calibrate/study/study_simulator.h"
#include "dem/experiment/experiment_table.h"

namespace repose::calibrate {

namespace {

/// Length, and the width of a spheroid of the same volume.
std::array<double, 3> sizes_mm(const dem::ClumpShape& grain) {
  const double length_mm = 2 * kMmPerM * grain.reach_m();
  const double volume_mm3 = std::pow(kMmPerM, 3) * grain.volume_m3;
  const double width_mm = std::sqrt(6 / std::numbers::pi * volume_mm3 / length_mm);
  return {length_mm, width_mm, width_mm};
}

dem::UsualBench bench_of(const dem::Study& study, const dem::ClumpShape& grain) {
  dem::UsualBench bench{.grain_mm = sizes_mm(grain),
                        .young_modulus_pa = study.model.grain_material.young_modulus_pa};
  constexpr double kHeightOfWidth = 3;
  bench.tube_diameter_mm = usual_tube_diameter_mm(bench.grain_mm);
  bench.tube_height_mm = kHeightOfWidth * bench.tube_diameter_mm;
  return bench;
}

bool is_measured(const dem::Measured& measured) {
  return measured.mean || !measured.values.empty();
}

/// With a number measured everywhere, a study's problem includes all of its experiments.
Problem with_all(dem::Study study, const dem::ClumpFile& grain, const Budget& budget) {
  std::set<std::string> made_up;
  for (auto& [experiment, described] : study.experiments) {
    described.is_held_out = false;  // a plan considers what could be fitted
    if (is_measured(described.measured)) continue;
    described.measured.mean = 1;
    made_up.insert(dem::name_of(experiment));
  }
  Problem problem = problem_of(study, grain, budget).problem;
  std::erase_if(problem.observables, [&](const Observable& observable) {
    return observable.reading == "value" && made_up.contains(observable.experiment);
  });
  return problem;
}

dem::Experiment named(const Experiment& experiment) {
  return &dem::experiment_named(experiment.name);
}

/// Leaves out added experiments until the fewest runs of all take no longer than `core_s`.
void keep_within(double core_s, OfferedStudy& offered) {
  constexpr double kMinute_s = 60;
  std::vector<Experiment>& experiments = offered.problem.experiments;
  const auto added_s = [&](const Experiment& experiment) {
    return offered.added.contains(named(experiment)) ? minimum_cost(experiment).seconds : 0;
  };
  double all_s = 0;
  for (const Experiment& experiment : experiments) all_s += minimum_cost(experiment).seconds;
  while (all_s > core_s) {
    const auto dearest = std::ranges::max_element(experiments, {}, added_s);
    const double seconds = added_s(*dearest);
    if (seconds <= 0) return;
    offered.notes.push_back(fmt::format(
        "{} is left out: its simulations would take {:.0f} minutes of a core alone. To have it in "
        "the plan, give --minutes {:.0f}.",
        dearest->name, seconds / kMinute_s, std::ceil(all_s / kMinute_s)));
    offered.added.erase(named(*dearest));
    offered.study.experiments.erase(named(*dearest));
    experiments.erase(dearest);
    all_s -= seconds;
  }
}

}  // namespace

std::set<dem::Experiment> every_experiment() {
  std::set<dem::Experiment> all;
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) all.insert(&entry);
  return all;
}

OfferedStudy offered_study(const dem::Study& study, const dem::ClumpFile& grain,
                           const Budget& budget, const std::set<dem::Experiment>& possible) {
  OfferedStudy offered{.study = study, .added = {}, .problem = {}, .notes = {}};
  const dem::UsualBench bench = bench_of(study, grain.shape);
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
    if (study.experiments.contains(&entry) || !possible.contains(&entry)) {
      continue;
    }
    const dem::StudyExperiment usual = usual_experiment(entry, bench);
    offered.added.emplace(&entry, usual);
    offered.study.experiments.emplace(&entry, usual);
  }
  offered.problem = with_all(offered.study, grain, budget);
  // A problem more expensive than its budget was given a larger one.
  offered.problem.settings.budget_s = budget.settings.budget_s;
  keep_within(kFirstFraction * budget.settings.budget_s, offered);
  for (const auto& [experiment, usual] : offered.added) {
    const dem::ExperimentEntry& entry = *experiment;
    if (entry.systematic == nullptr || !(entry.systematic(usual.protocol).sd > 0)) continue;
    offered.notes.push_back(
        fmt::format("{}: {}.", entry.name, entry.systematic(usual.protocol).note));
  }
  return offered;
}

namespace {

/// The jobs of a larger budget begin with those of a smaller one: this includes all of them.
constexpr double kAll_s = 1e9;

}  // namespace

std::vector<Offer> offers_in(const RunStore& folder, const dem::Study& study,
                             const dem::ClumpFile& grain) {
  const OfferedStudy offered = offered_study(study, grain, plan_budget(kAll_s), every_experiment());
  const StudySimulator simulator(offered.study, grain, offered.problem.parameters);
  std::vector<Offer> offers;
  for (const Experiment& experiment : offered.problem.experiments) {
    const dem::ExperimentEntry& entry = dem::experiment_named(experiment.name);
    const auto added = offered.added.find(&entry);
    if (added == offered.added.end()) continue;
    offers.push_back(
        {.experiment = experiment, .study_lines = study_section(entry, added->second), .runs = {}});
  }
  for (const Job& job : plan_jobs(offered)) {
    const auto offer = std::ranges::find(offers, job.experiment,
                                         [](const Offer& one) { return one.experiment.name; });
    if (offer == offers.end()) continue;
    if (const auto run = folder.find_whole(simulator.spec(job), job.seed)) {
      offer->runs.push_back(run_of(job, *run));
    }
  }
  return offers;
}

}  // namespace repose::calibrate
