#include "calibrate/result/runs_surface.h"

#include <algorithm>

#include "base/input_error.h"

namespace repose::calibrate {
namespace {

const Experiment& experiment_of(const Problem& problem, const Observable& observable) {
  return *std::find_if(problem.experiments.begin(), problem.experiments.end(),
                       [&](const auto& one) { return one.name == observable.experiment; });
}

RunTable table_of(const Problem& problem, const Observable& observable,
                  const std::vector<Run>& runs) {
  const Experiment& experiment = experiment_of(problem, observable);
  RunTable table;
  table.name = observable.name;
  table.response_name = observable.name;
  for (const std::size_t k : experiment.parameters) {
    const Parameter& parameter = problem.parameters[k];
    table.factors.push_back({.name = parameter.name, .low = parameter.min, .high = parameter.max});
  }
  table.levels.resize(table.factors.size());
  for (const Run& run : runs) {
    const auto reading = run.readings.find(observable.reading);
    if (run.job.experiment != experiment.name || reading == run.readings.end()) continue;
    for (std::size_t i = 0; i < table.factors.size(); ++i) {
      table.levels[i].push_back(run.job.values[experiment.parameters[i]]);
    }
    table.responses.push_back(reading->second);
  }
  return table;
}

}  // namespace

std::optional<SurfaceReport> surface_of_runs(const Problem& problem, const Observable& observable,
                                             const std::vector<Run>& runs) {
  const RunTable table = table_of(problem, observable, runs);
  for (const SurfaceModel model :
       {SurfaceModel::quadratic, SurfaceModel::interaction, SurfaceModel::linear}) {
    try {
      return report_on(regress(table, model), WantedValue{observable.mean});
    } catch (const base::InputError&) {
      continue;  // too few runs for these terms
    }
  }
  return std::nullopt;
}

}  // namespace repose::calibrate
