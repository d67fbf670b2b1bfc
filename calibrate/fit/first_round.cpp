#include "calibrate/fit/first_round.h"

#include "calibrate/fit/budget.h"
#include "calibrate/fit/sequence.h"
#include "calibrate/fit/unit_box.h"

namespace repose::calibrate {
namespace {

constexpr int kRepeatEvery = 5;

}  // namespace

std::vector<Job> first_round(const Problem& problem) {
  const std::vector<Experiment> experiments = measured_experiments(problem);
  const std::vector<int> counts = first_round_jobs(problem);
  std::vector<Job> jobs;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const Experiment& experiment = experiments[e];
    std::size_t place = 0;
    for (int k = 0; k < counts[e]; ++k) {
      // The job after every fifth place is at that place again.
      const bool repeat = experiment.is_stochastic && k % (kRepeatEvery + 1) == kRepeatEvery;
      if (k > 0 && !repeat) ++place;
      const Point own = sequence_point(place, experiment.parameters.size());
      Point point(problem.parameters.size(), .5);
      for (std::size_t c = 0; c < own.size(); ++c) point[experiment.parameters[c]] = own[c];
      jobs.push_back(
          job_at(problem, experiment, point, problem.settings.seed + static_cast<unsigned>(k)));
    }
  }
  return jobs;
}

}  // namespace repose::calibrate
