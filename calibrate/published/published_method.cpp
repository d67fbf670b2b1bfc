#include "calibrate/published/published_method.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "calibrate/fit/points.h"
#include "calibrate/statistics/design/design.h"
#include "calibrate/study/job_runner.h"

namespace repose::calibrate {
namespace {

// First of three indices in Problem::parameters.
constexpr std::size_t kFirstOfWall = 0, kFirstOfGrains = 3;
constexpr int kSweepLevels = 9;
constexpr int kVerificationRuns = 10;
// Step k is at k (.1, .1, .01): published for restitution, sliding and rolling friction.
constexpr std::array kStep = {.1, .1, .01};
constexpr int kSteps = 5;

const Observable& observable_of(const Problem& problem, const std::string& experiment) {
  for (const Observable& observable : problem.observables) {
    if (observable.experiment == experiment && observable.reading == "value") return observable;
  }
  throw base::InputError(
      {.where = "the published method",
       .value = fmt::format("[experiment.{}] has no measured value, and every step needs its own",
                            experiment),
       .fix = fmt::format("add it, or use {}.", base::field("the joint method"))});
}

void require_all_sought(const Problem& problem) {
  const auto is_of_six = [](const Parameter& parameter) {
    return (parameter.name.starts_with("contact.particle_wall.") ||
            parameter.name.starts_with("contact.particle_particle.")) &&
           !parameter.name.ends_with(".restitution_exponent");
  };
  if (problem.parameters.size() == kFirstOfGrains + kStep.size() &&
      std::ranges::all_of(problem.parameters, is_of_six)) {
    return;
  }
  throw base::InputError(
      {.where = "the published method",
       .value = "finds restitution, sliding and rolling friction of both pairs and nothing else, "
                "and some of the six have no bounds, or others have",
       .fix = fmt::format("give bounds to all of these and to no others, or use {}.",
                          base::field("the joint method"))});
}

/// The values of a job: parameters that the experiment does not depend on stay at mid-range, so
/// that equal runs have equal names.
std::vector<double> values_for(const Problem& problem, const std::string& experiment,
                               const std::vector<double>& set) {
  std::vector<double> values;
  for (const Parameter& parameter : problem.parameters) {
    values.push_back((parameter.min + parameter.max) / 2);
  }
  for (const Experiment& known : problem.experiments) {
    if (known.name != experiment) continue;
    for (const std::size_t place : known.parameters) values[place] = set[place];
  }
  return values;
}

class PublishedMethod {
 public:
  PublishedMethod(const Problem& problem, const StudyContext& context)
      : problem_(problem), context_(context), runner_(problem, context) {
    for (const Parameter& parameter : problem.parameters) {
      set_.push_back((parameter.min + parameter.max) / 2);
    }
  }

  std::optional<PublishedOutcome> run() {
    const std::array sweeps = {std::pair("drop", kFirstOfWall), std::pair("tilt", kFirstOfWall + 1),
                               std::pair("roll", kFirstOfWall + 2)};
    for (const auto& [experiment, place] : sweeps) {
      if (!sweep(experiment, place)) return std::nullopt;
    }
    outcome_.measured_angle_deg = observable_of(problem_, "heap").mean;
    if (!ascend() || !fit_surface() || !check()) return std::nullopt;
    outcome_.values = set_;
    outcome_.heap_angles_deg = heap_angles_deg(context_, outcome_.checks);
    return std::move(outcome_);
  }

 private:
  bool sweep(const std::string& experiment, std::size_t place) {
    const Parameter& parameter = problem_.parameters[place];
    const Observable& observable = observable_of(problem_, experiment);
    const Factor factor{.name = parameter.name, .low = parameter.min, .high = parameter.max};
    std::vector<Job> jobs;
    for (const DesignRun& run : calibrate::sweep({factor}, kSweepLevels).runs) {
      set_[place] = factor.natural(run.coded.front());
      jobs.push_back(job(experiment, jobs.size()));
    }
    const auto runs = runner_.get("sweep of " + parameter.name, jobs);
    if (!runs) return false;
    PublishedSweep swept{.parameter = parameter.name,
                         .observable = observable.name,
                         .measured = observable.mean,
                         .levels = {},
                         .results = {}};
    for (const Run& run : *runs) {
      if (!run.failure.empty()) continue;
      swept.levels.push_back(run.job.values[place]);
      swept.results.push_back(run.readings.at("value"));
    }
    solve(regress({.name = "sweep of " + parameter.name,
                   .factors = {factor},
                   .levels = {swept.levels},
                   .response_name = observable.name,
                   .responses = swept.results},
                  SurfaceModel::quadratic),
          swept);
    set_[place] = swept.value;
    outcome_.sweeps.push_back(std::move(swept));
    return true;
  }

  /// The crossing nearest to the middle of the levels; if there is none, the end or vertex closest
  /// to the measured value.
  static void solve(const Regression& parabola, PublishedSweep& swept) {
    swept.r2 = parabola.r2;
    const TargetSet solved = solve_target(parabola, {swept.measured});
    const Factor& factor = parabola.factors.front();
    const auto nearer = [&](const Crossing& a, const Crossing& b) {
      return std::abs(a.point.coded.front()) < std::abs(b.point.coded.front());
    };
    const auto crossing =
        std::min_element(solved.through_centre.begin(), solved.through_centre.end(), nearer);
    swept.is_reached = crossing != solved.through_centre.end();
    if (swept.is_reached) {
      swept.value = factor.natural(crossing->point.coded.front());
      return;
    }
    const BoxExtremes extremes = extremes_in_box(parabola);
    const bool is_above = swept.measured > extremes.greatest.value;
    swept.value = (is_above ? extremes.greatest : extremes.least).natural.front();
  }

  std::optional<std::vector<PublishedHeap>> heaps(const std::string& stage,
                                                  const std::vector<std::vector<double>>& sets,
                                                  std::vector<Run>* saved = nullptr) {
    std::vector<Job> jobs;
    for (const std::vector<double>& coefficients : sets) {
      std::copy(coefficients.begin(), coefficients.end(), set_.begin() + kFirstOfGrains);
      jobs.push_back(job("heap", heap_seeds_++));
    }
    const auto runs = runner_.get(stage, jobs);
    if (!runs) return std::nullopt;
    if (saved != nullptr) *saved = *runs;
    std::vector<PublishedHeap> heaps;
    for (std::size_t k = 0; k < sets.size(); ++k) {
      heaps.push_back({.coefficients = sets[k], .angle_deg = {}, .error_percent = {}});
      if (!(*runs)[k].failure.empty()) continue;
      const double angle = (*runs)[k].readings.at("value");
      heaps.back().angle_deg = angle;
      heaps.back().error_percent =
          100 * std::abs(angle - outcome_.measured_angle_deg) / outcome_.measured_angle_deg;
    }
    return heaps;
  }

  bool ascend() {
    const std::vector<double> step(kStep.begin(), kStep.end());
    std::vector<std::vector<double>> sets;
    for (int k = 1; k <= kSteps; ++k) {
      std::vector<double> set;
      for (std::size_t i = 0; i < step.size(); ++i) set.push_back(within(i, k * step[i]));
      sets.push_back(std::move(set));
    }
    auto ascent = heaps("steepest ascent", sets);
    if (!ascent) return false;
    outcome_.ascent = *std::move(ascent);
    const auto error = [](const PublishedHeap& heap) {
      return heap.error_percent.value_or(std::numeric_limits<double>::infinity());
    };
    const auto best = std::min_element(
        outcome_.ascent.begin(), outcome_.ascent.end(),
        [&](const PublishedHeap& a, const PublishedHeap& b) { return error(a) < error(b); });
    outcome_.best_step = static_cast<std::size_t>(best - outcome_.ascent.begin());
    return true;
  }

  bool fit_surface() {
    const std::vector<double>& centre = outcome_.ascent[outcome_.best_step].coefficients;
    std::vector<Factor> factors;
    for (std::size_t i = 0; i < kStep.size(); ++i) {
      factors.push_back({.name = problem_.parameters[kFirstOfGrains + i].name,
                         .low = centre[i] - kStep[i],
                         .high = centre[i] + kStep[i]});
    }
    std::vector<std::vector<double>> sets;
    for (const DesignRun& run : central_composite(factors).runs) {
      std::vector<double> set;
      for (std::size_t i = 0; i < factors.size(); ++i) {
        set.push_back(within(i, factors[i].natural(run.coded[i])));
      }
      sets.push_back(std::move(set));
    }
    auto composite = heaps("central composite design", sets);
    if (!composite) return false;
    outcome_.composite = *std::move(composite);
    RunTable table{.name = "central composite design",
                   .factors = factors,
                   .levels = std::vector<std::vector<double>>(factors.size()),
                   .response_name = "relative error, %",
                   .responses = {}};
    for (const PublishedHeap& heap : outcome_.composite) {
      if (!heap.error_percent) continue;
      for (std::size_t i = 0; i < factors.size(); ++i) {
        table.levels[i].push_back(heap.coefficients[i]);
      }
      table.responses.push_back(*heap.error_percent);
    }
    outcome_.surface = report_on(regress(table, SurfaceModel::quadratic), std::nullopt);
    return true;
  }

  bool check() {
    const std::vector<std::vector<double>> sets(kVerificationRuns,
                                                outcome_.surface.extremes.least.natural);
    auto verification = heaps("ten heaps with the optimum", sets, &outcome_.checks);
    if (!verification) return false;
    outcome_.verification = *std::move(verification);
    return true;
  }

  double within(std::size_t grain_coefficient, double value) const {
    const Parameter& parameter = problem_.parameters[kFirstOfGrains + grain_coefficient];
    return std::clamp(value, parameter.min, parameter.max);
  }

  Job job(const std::string& experiment, std::uint64_t number) const {
    return {.experiment = experiment,
            .values = values_for(problem_, experiment, set_),
            .seed = problem_.settings.seed + number};
  }

  const Problem& problem_;
  const StudyContext& context_;
  JobRunner runner_;
  std::vector<double> set_;
  std::uint64_t heap_seeds_ = 0;
  PublishedOutcome outcome_;
};

}  // namespace

std::optional<PublishedOutcome> calibrate_as_published(const Problem& problem,
                                                       const StudyContext& context) {
  require_all_sought(problem);
  return PublishedMethod(problem, context).run();
}

}  // namespace repose::calibrate
