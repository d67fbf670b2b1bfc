#include "calibrate/study/study_simulator.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "calibrate/study/coefficients.h"

namespace repose::calibrate {

Run run_of(const SimulatedJob& done) {
  Run run{.job = done.job, .readings = readings_of(done.run), .failure = done.run.failure};
  if (run.failure.empty() && !run.readings.contains("value")) {
    run.readings.clear();
    run.failure = "it has no value";
  }
  return run;
}

StudySimulator::StudySimulator(dem::Study study, dem::ClumpFile grain,
                               const std::vector<Parameter>& sought, int heap_views)
    : study_(std::move(study)), grain_(std::move(grain)), heap_views_(heap_views) {
  for (const Parameter& parameter : sought) names_.push_back(parameter.name);
  study_.model.threads = 1;
}

RunSpec StudySimulator::spec(const Job& job) const {
  const dem::Experiment experiment = dem::experiment_named(job.experiment).experiment;
  RunSpec spec = spec_of(study_, experiment, grain_, heap_views_);
  spec.model.stiffness_factor = std::min(1., spec.model.stiffness_factor * job.relative_stiffness);
  for (std::size_t k = 0; k < names_.size(); ++k) {
    // An experiment without a part has none of its coefficients.
    double* coefficient = find_coefficient(names_[k], spec.model);
    if (coefficient != nullptr) *coefficient = job.values.at(k);
  }
  return spec;
}

SimulatedJob StudySimulator::simulate(const Job& job,
                                      const std::atomic<bool>& is_interrupted) const {
  const SimulateOptions options{
      .folder = folder_, .trajectory = {}, .report = [&](double) { return !is_interrupted; }};
  SimulatedJob done{.job = job, .run = simulate_experiment(spec(job), job.seed, options)};
  if (!done.run.picture_error.empty()) {
    throw std::runtime_error(
        fmt::format("no pictures of heaps can be drawn: {}", done.run.picture_error));
  }
  return done;
}

}  // namespace repose::calibrate
