#include "calibrate/plan/offers.h"

#include <algorithm>

#include "calibrate/plan/plan.h"
#include "calibrate/start/usual_experiment.h"
#include "calibrate/study/study_simulator.h"
#include "dem/study/experiment_table.h"

namespace repose::calibrate {
namespace {

/// The jobs of a larger budget begin with those of a smaller one: this has all that there are.
constexpr double kAll_s = 1e9;

}  // namespace

std::vector<Offer> offers_in(const RunFolder& folder, const dem::Study& study,
                             const dem::ClumpFile& grain) {
  const OfferedStudy offered = offered_study(study, grain, plan_budget(kAll_s), every_experiment());
  const StudySimulator simulator(offered.study, grain, offered.problem.parameters);
  std::vector<Offer> offers;
  for (const Experiment& experiment : offered.problem.experiments) {
    const dem::ExperimentEntry& entry = dem::experiment_named(experiment.name);
    const auto added = offered.added.find(entry.experiment);
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
