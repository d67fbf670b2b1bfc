#include "calibrate/study/study_problem.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "base/atomic_file.h"
#include "calibrate/experiment/run_result.h"
#include "calibrate/fit/budget.h"
#include "calibrate/fit/points.h"
#include "calibrate/statistics/summary.h"
#include "calibrate/study/study_simulator.h"
#include "dem/contact/adhesion.h"
#include "dem/experiment/experiment_table.h"
#include "dem/study/held_inputs.h"

namespace repose::calibrate {
namespace {

/// What a bench could measure: the experiment's main reading, and others besides.
std::vector<std::string> measurable(const dem::ExperimentEntry& entry) {
  std::vector<std::string> names = {"value"};
  for (const dem::Reading& reading : entry.readings) {
    if (reading.is_measurable) names.emplace_back(reading.name);
  }
  return names;
}

std::string unit_of(const dem::ExperimentEntry& entry, const std::string& reading) {
  return std::string(reading == "value" ? entry.unit : dem::reading_named(entry, reading).unit);
}

/// Approximate duration of a run, s. Coefficients still open hardly affect it.
double run_cost_s(const dem::Study& study, const dem::ClumpShape& grain,
                  const dem::ExperimentEntry& entry) {
  dem::Model model = dem::model_for(study, &entry);
  model.grain = grain;
  std::vector<dem::PairCoefficients*> pairs = {&model.grain_wall, &model.grain_grain};
  for (auto& [part, surface] : model.parts) pairs.push_back(&surface.with_grain);
  for (dem::PairCoefficients* pair : pairs) {
    for (double* value : {&pair->restitution, &pair->sliding_friction, &pair->rolling_friction}) {
      if (std::isnan(*value)) *value = .3;
    }
    pair->restitution_exponent = 0;
  }
  return entry.cost_s(model, study.experiments.at(&entry).protocol);
}

/// Fraction of it that scales with the number of spheres.
double spheres_share(const dem::Study& study, const dem::ClumpShape& grain,
                     const dem::ExperimentEntry& entry) {
  dem::ClumpShape twice = grain;
  twice.spheres.insert(twice.spheres.end(), grain.spheres.begin(), grain.spheres.end());
  return std::max(0., run_cost_s(study, twice, entry) / run_cost_s(study, grain, entry) - 1);
}

/// The same with grains so many times as large, in the same vessels.
double larger_cost_s(const dem::Study& study, const dem::ClumpShape& grain,
                     const dem::ExperimentEntry& entry, double size) {
  if (size == 1) return run_cost_s(study, grain, entry);
  dem::Study larger = study;
  entry.coarsen(larger.experiments.at(&entry).protocol, size);
  return run_cost_s(larger, dem::scaled(grain, size), entry);
}

constexpr double kSizeDecimals = 100;  // sizes can be printed in full

/// Sizes of the grains of full and of coarse runs; of these 1: there are none.
struct GrainSizes {
  double full = 1;
  double coarse = 1;
};

/// The smallest whose runs take no longer, if they are not too large; `coarse` and no other if the
/// rest is hardly smaller.
GrainSizes grain_sizes(const dem::Study& study, const dem::ClumpShape& grain,
                       const dem::ExperimentEntry& entry, double coarse, double longest_s) {
  constexpr double kWorthIt = 1.5;  // a fifth of the cost
  constexpr double kMost = 2.5;     // of still larger grains there may be no heap
  constexpr int kHalvings = 20;
  const auto is_too_long = [&](double size) {
    return larger_cost_s(study, grain, entry, size) > longest_s;
  };
  if (!is_too_long(1)) return {.full = 1, .coarse = coarse};
  double low = 1, high = coarse;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = std::sqrt(low * high);
    (is_too_long(middle) ? low : high) = middle;
  }
  high = std::min(kMost, std::ceil(kSizeDecimals * high) / kSizeDecimals);
  if (high * kWorthIt > coarse && coarse <= kMost) return {.full = coarse, .coarse = 1};
  return {.full = high, .coarse = coarse};
}

/// How much more a full run takes than a coarse one beyond what fewer grains and longer steps save,
/// each of which goes as a power of their size.
double many_grains(const dem::Study& study, const dem::ClumpShape& grain,
                   const dem::ExperimentEntry& entry, const GrainSizes& sizes) {
  if (sizes.coarse == 1) return 1;
  return larger_cost_s(study, grain, entry, sizes.full) /
         (std::pow(sizes.coarse / sizes.full, 4) *
          larger_cost_s(study, grain, entry, sizes.coarse));
}

bool is_ball(const dem::CalliperSizes& sizes) {
  return sizes.length_m == sizes.width_m && sizes.width_m == sizes.thickness_m &&
         sizes.tip_fraction == 0;
}

/// More spheres follow the surface that the study's were fitted to more closely.
GrainSpheres spheres_of(const dem::GrainSource& source, const dem::ClumpShape& grain) {
  const int count = static_cast<int>(grain.spheres.size());
  const auto none_closer = [&](std::string why) {
    return GrainSpheres{.count = count, .most = count, .no_closer = std::move(why)};
  };
  if (source.clump) return none_closer("a clump file has its spheres, and no surface to be filled");
  if (count == 1 && source.sizes && is_ball(*source.sizes)) {
    return none_closer("one sphere is exactly the shape of this particle");
  }
  if (count >= dem::kMaxSpheres) {
    return none_closer(fmt::format("more than {} spheres are not made", dem::kMaxSpheres));
  }
  return {.count = count, .most = dem::kMaxSpheres, .no_closer = {}};
}

}  // namespace

Parameter sought_parameter(const std::string& name, const dem::Coefficient& coefficient) {
  Parameter parameter{.name = name, .min = coefficient.min, .max = coefficient.max, .prior = {}};
  if (coefficient.known_mean) {
    parameter.prior = Prior{*coefficient.known_mean, *coefficient.known_sd};
  }
  parameter.useful_half_width = coefficient.useful_half_width;
  if (coefficient.are_bounds_known) {
    parameter.bounds_are =
        *coefficient.are_bounds_known ? BoundsOrigin::known : BoundsOrigin::convenience;
  }
  return parameter;
}

namespace {

std::vector<Parameter> open_parameters(const dem::Study& study) {
  std::vector<Parameter> parameters;
  for (const NamedCoefficient& named : coefficients_of(study)) {
    if (!named.coefficient.is_free()) continue;
    Parameter parameter = sought_parameter(named.name, named.coefficient);
    for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
      if (entry.tells == parameter.name) parameter.identified_by.emplace_back(entry.name);
    }
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

/// A few readings may lie closer together than the uncertainty of each: their scatter is at least
/// that. An assumed scatter is that of the grains, without this uncertainty.
void count_uncertainty(double of_each, double usual_scatter, Observable& observable) {
  if (observable.sd) observable.sd = std::max(*observable.sd, of_each);
  if (observable.sd || !(of_each > 0) || observable.mean == 0) return;
  observable.assumed_sd_fraction = std::hypot(usual_scatter, of_each / std::abs(observable.mean));
}

void share(SystematicPart part, Observable& observable) {
  observable.systematic_sd = std::hypot(observable.systematic_sd, part.sd);
  observable.systematic.push_back(std::move(part));
}

void share(const std::vector<dem::Systematic>& parts, Observable& observable) {
  for (const dem::Systematic& part : parts) share({part.name, part.sd, part.note}, observable);
}

/// Mean, scatter and number of what was measured; without a measurement the mean is 0.
Observable observable_of(const dem::Measured& measured, double usual_scatter) {
  Observable observable;
  observable.n = measured.count.value_or(1);
  observable.sd = measured.sd;
  observable.tolerance = measured.tolerance;
  observable.mean = measured.mean.value_or(0);
  share(measured.systematic, observable);
  if (measured.values.empty()) return observable;
  const calibrate::Summary repeats = calibrate::summarise(measured.values);
  observable.mean = repeats.mean;
  observable.sd = repeats.sd;
  observable.n = repeats.n;
  count_uncertainty(measured.value_uncertainty.value_or(0), usual_scatter, observable);
  return observable;
}

Observable with(const dem::SystematicFraction& systematic, Observable observable) {
  if (!(systematic.sd > 0)) return observable;
  share({.name = std::string(systematic.name),
         .sd = systematic.sd * std::abs(observable.mean),
         .note = std::string(systematic.note)},
        observable);
  return observable;
}

/// Stated common uncertainty of readings, which the study need not have yet.
double stated_sd(const std::vector<dem::Systematic>& parts) {
  double sd = 0;
  for (const dem::Systematic& part : parts) sd = std::hypot(sd, part.sd);
  return sd;
}

/// Uncertainties that a study states for its numbers, for the experiments that were measured.
std::vector<FixedInput> fixed_inputs_of(const dem::Study& study, const dem::ClumpShape& grain,
                                        const Problem& problem) {
  std::vector<FixedInput> inputs;
  for (const dem::HeldInput& held : dem::held_inputs(study)) {
    FixedInput input{.name = held.name,
                     .unit = held.unit,
                     .value = held.value,
                     .sd = held.sd,
                     .is_assumed = held.is_assumed,
                     .step = {.input = held.name, .change = held.step},
                     .experiments = {}};
    dem::Study changed = study;
    dem::change_input(changed, held.name, held.step);
    for (const Experiment& experiment : measured_experiments(problem)) {
      const dem::ExperimentEntry& entry = dem::experiment_named(experiment.name);
      if (!dem::has_effect(held.name, &entry)) continue;
      input.experiments.push_back(experiment.name);
      input.step.work = std::max(
          input.step.work, run_cost_s(changed, grain, entry) / run_cost_s(study, grain, entry));
    }
    if (!input.experiments.empty()) inputs.push_back(std::move(input));
  }
  return inputs;
}

std::optional<double> coarse_size(const dem::ExperimentEntry& entry, const dem::Protocol& protocol,
                                  const dem::ClumpShape& grain) {
  return entry.coarse_size == nullptr ? std::nullopt : entry.coarse_size(grain, protocol);
}

class StudyProblemBuilder {
 public:
  StudyProblemBuilder(const dem::Study& study, const dem::ClumpFile& grain)
      : study_(study), grain_(grain) {}

  StudyProblem make(const Budget& budget) {
    made_.problem.settings = budget.settings;
    is_coarse_allowed_ = !budget.is_full;
    longest_run_s_ = budget.longest_run_s;
    made_.problem.settings.seed = study_.seed;
    made_.problem.parameters = open_parameters(study_);
    made_.problem.spheres = spheres_of(study_.grain, grain_.shape);
    made_.problem.spheres.share_damping = study_.model.damping == dem::DampingModel::shared;
    if (made_.problem.parameters.empty()) {
      base::refuse(study_.file, "every coefficient has a value, so there is nothing to fit",
                   "give bounds to what you seek, as in restitution = { min = 0.1, max = 0.6 }.");
    }
    if (auto sticky = dem::adhesion_warning(grain_.shape.volume_m3,
                                            study_.model.grain_material.density_kg_m3)) {
      made_.notes.push_back(*std::move(sticky));
    }
    for (const dem::ExperimentEntry& entry : dem::all_experiments()) add(entry);
    if (made_.problem.observables.empty()) {
      base::refuse(study_.file,
                   fmt::format("no experiment that depends on a fitted coefficient has readings{}",
                               made_.problem.held_out.empty() ? "" : ", but for those held out"),
                   "give one or more experiments their bench readings, as in measured = { mean = "
                   "9.42, sd = 0.5, n = 10 }.");
    }
    allow_a_fit();
    made_.problem.fixed_inputs = fixed_inputs_of(study_, grain_.shape, made_.problem);
    require_sound(made_.problem);
    return std::move(made_);
  }

 private:
  void add(const dem::ExperimentEntry& entry) {
    const auto described = study_.experiments.find(&entry);
    if (described == study_.experiments.end()) return;
    const std::string name(entry.name);
    std::vector<std::size_t> with_effect;
    for (std::size_t k = 0; k < made_.problem.parameters.size(); ++k) {
      if (dem::depends_on(entry, made_.problem.parameters[k].name)) with_effect.push_back(k);
    }
    const dem::Measured& measured = described->second.measured;
    const dem::SystematicFraction systematic = entry.systematic == nullptr
                                                   ? dem::SystematicFraction{}
                                                   : entry.systematic(described->second.protocol);
    note_pictures_of_heaps(measured);
    note_unknown_camera(entry, described->second);
    note_unknown_definition(entry, described->second);
    const bool is_measured = measured.mean || !measured.values.empty();
    if (with_effect.empty()) {
      if (is_measured) {
        made_.notes.push_back(
            fmt::format("[experiment.{}] depends on no fitted coefficient: its readings are "
                        "not used",
                        name));
      }
      return;
    }
    const GrainSizes sizes = sizes_of(entry, described->second.protocol);
    const double model_error = described->second.model_error.value_or(entry.usual_model_error);
    const double size_error = entry.coarse_error * (sizes.full - 1);
    note_larger_grains(entry, sizes.full, size_error);
    made_.problem.experiments.push_back(
        {.name = name,
         .parameters = with_effect,
         .run_s = larger_cost_s(study_, grain_.shape, entry, sizes.full),
         .is_stochastic = entry.is_stochastic,
         .measurable = measurable(entry),
         .readings_per_run = readings_per_run(entry),
         .scatter_within = entry.is_pictured ? kOneViewScatter : "",
         .real_stiffness = 1 / dem::model_for(study_, &entry).stiffness_factor,
         .spheres_share = spheres_share(study_, grain_.shape, entry),
         .many_grains = many_grains(study_, grain_.shape, entry, sizes),
         .systematic_fraction = systematic.sd,
         .systematic_sd = stated_sd(measured.systematic),
         .usual_scatter = entry.usual_scatter,
         .model_fraction = std::hypot(model_error, size_error),
         .size_fraction = size_error,
         .full = {.size = sizes.full},
         .coarse = sizes.coarse == 1 ? std::nullopt
                                     : std::optional(AssumedInputs{.size = sizes.coarse})});
    into_ = described->second.is_held_out ? &made_.problem.held_out : &made_.problem.observables;
    if (is_measured)
      add(with(systematic, observable_of(measured, entry.usual_scatter)), entry, "value");
    for (const dem::MeasuredReading& reading : measured.also) add(reading, systematic, entry);
  }

  void add(const dem::MeasuredReading& reading, const dem::SystematicFraction& systematic,
           const dem::ExperimentEntry& entry) {
    Observable observable;
    observable.mean = reading.mean;
    observable.sd = reading.sd;
    observable.n = reading.count.value_or(1);
    observable.tolerance = reading.tolerance;
    share(reading.systematic, observable);
    const dem::Reading& known = dem::reading_named(entry, reading.name);
    observable.has_own_trials = known.has_own_trials;
    if (known.shares_systematic) observable = with(systematic, observable);
    add(observable, entry, reading.name);
  }

  void note_pictures_of_heaps(const dem::Measured& measured) {
    if (!measured.within_heaps) return;
    const auto& [pictures, sd] = *measured.within_heaps;
    made_.notes.push_back(fmt::format(
        "[experiment.{}] has {} pictures of {} heaps, and each heap counts once, with the mean "
        "of its pictures. Pictures of one heap scatter by {:.2g} deg (standard deviation), which "
        "says nothing about how heaps differ",
        dem::pictured_experiment().name, pictures, measured.values.size(), sd));
  }

  void note_unknown_camera(const dem::ExperimentEntry& entry,
                           const dem::StudyExperiment& described) {
    const dem::Measured& measured = described.measured;
    if (entry.camera == nullptr || entry.camera(described.protocol)) return;
    if (measured.pictures.empty() && measured.videos.empty()) return;
    made_.notes.push_back(fmt::format(
        "[experiment.{}] does not say where its pictures were taken from, and simulated heaps "
        "are seen from far away: of heaps of nuts a level camera three widths away reads 0.8 "
        "degrees less than that. Fix: camera_distance_mm, from the heap's middle to the lens, and "
        "camera_height_mm, of the lens above the plate",
        entry.name));
  }

  void note_unknown_definition(const dem::ExperimentEntry& entry,
                               const dem::StudyExperiment& described) {
    if (!is_definition_assumed(entry, described)) return;
    made_.notes.push_back(fmt::format(
        "[experiment.{}] does not say by which definition its angle was measured: {} is assumed, "
        "{}. Others differ by degrees; many publications fit a line to the whole flank. Fix: "
        "definition = \"whole_flank\", or whichever it is; repose measure --definitions lists "
        "them",
        entry.name, base::kUsualDefinition.name, base::kUsualDefinition.description));
  }

  /// Larger ones if the budget wants them and they are worthwhile.
  GrainSizes sizes_of(const dem::ExperimentEntry& entry, const dem::Protocol& protocol) const {
    const auto coarse = coarse_size(entry, protocol, grain_.shape);
    const dem::StudyExperiment& described = study_.experiments.at(&entry);
    // Larger grains are fewer, which a count of them would show.
    const bool is_counted =
        std::ranges::any_of(described.measured.also, [&](const dem::MeasuredReading& reading) {
          return dem::reading_named(entry, reading.name).unit.empty();
        });
    if (!is_coarse_allowed_ || !coarse || is_counted) return {};
    // A prediction makes many more runs than checks do.
    constexpr double kOfPrediction = .25;
    const double rounded = std::round(kSizeDecimals * *coarse) / kSizeDecimals;
    return grain_sizes(study_, grain_.shape, entry, rounded,
                       (described.is_held_out ? kOfPrediction : 1) * longest_run_s_);
  }

  void note_larger_grains(const dem::ExperimentEntry& entry, double size, double error) {
    constexpr double kPercent = 100;
    if (size == 1) return;
    made_.notes.push_back(fmt::format(
        "[experiment.{}] one run with the study's own grains would take {:.2g} times as long as "
        "this budget allows, so none is made: what is to be compared with the bench is simulated "
        "with grains {:.3g} times as large in the same vessels, and a model error of {:.2g} % is "
        "added for what that may change. Fix, to use the study's own: a larger budget, or "
        "--fidelity full.",
        entry.name, run_cost_s(study_, grain_.shape, entry) / longest_run_s_, size,
        kPercent * error));
  }

  int readings_per_run(const dem::ExperimentEntry& entry) const {
    if (entry.readings_per_run == nullptr) return 1;
    return entry.readings_per_run(study_.experiments.at(&entry).protocol);
  }

  /// A study of many grains costs more than budgets are designed for.
  void allow_a_fit() {
    const Cost least = minimum_cost(made_.problem);
    FitSettings& settings = made_.problem.settings;
    const double enough_s = least_budget_s(made_.problem);
    if (settings.budget_s >= enough_s) return;
    // Minutes would be those of the core that cost_s refers to, not of this machine.
    made_.notes.push_back(fmt::format(
        "runs of this study take long: the budget is raised to {:.1f} times as much, the least "
        "that a fit takes: {} simulations in its first round, and over half of their work in later "
        "ones. repose calibrate --dry-run says how long all of it takes here. Fix, to be faster: "
        "fewer grains or softer ones.",
        enough_s / settings.budget_s, least.jobs));
    settings.budget_s = enough_s;
  }

  void add(Observable observable, const dem::ExperimentEntry& entry, const std::string& reading) {
    const std::string name(entry.name);
    observable.name = reading == "value" ? name : name + '.' + reading;
    observable.experiment = name;
    observable.reading = reading;
    observable.unit = unit_of(entry, reading);
    observable.model_sd =
        made_.problem.experiments.back().model_fraction * std::abs(observable.mean);
    observable.size_sd = made_.problem.experiments.back().size_fraction * std::abs(observable.mean);
    const dem::Range readable = dem::readable_in(observable.unit);
    observable.least = readable.from;
    observable.most = readable.to;
    if (observable.sd && observable.n < 2) {
      made_.notes.push_back(fmt::format(
          "{}: sd = {:g} of n = 1 is not used, since one reading has no scatter. Fix: give the n "
          "of "
          "the readings that it is the scatter of; or, if it says how well the reading is known, "
          "bias_sd.",
          observable.name, *observable.sd));
    }
    if (!observable.sd || observable.n < 2) {
      observable.sd.reset();
      observable.assumed_sd_fraction = observable.assumed_sd_fraction.value_or(entry.usual_scatter);
    }
    into_->push_back(std::move(observable));
  }

  const dem::Study& study_;
  const dem::ClumpFile& grain_;
  bool is_coarse_allowed_ = false;
  double longest_run_s_ = 0;
  StudyProblem made_;
  std::vector<Observable>* into_ = &made_.problem.observables;  ///< fitted, or held out
};

}  // namespace

bool is_definition_assumed(const dem::ExperimentEntry& entry,
                           const dem::StudyExperiment& described) {
  const dem::Measured& measured = described.measured;
  const bool is_ours = measured.is_seen() || measured.sheet.has_value();
  const bool is_told = measured.mean.has_value() || !measured.values.empty();
  return entry.is_pictured && described.definition.empty() && is_told && !is_ours;
}

bool has_coarse_runs(const dem::Study& study, const dem::ClumpShape& grain) {
  return std::ranges::any_of(study.experiments, [&](const auto& described) {
    return coarse_size(*described.first, described.second.protocol, grain).has_value();
  });
}

StudyProblem problem_of(const dem::Study& study, const dem::ClumpFile& grain,
                        const Budget& budget) {
  return StudyProblemBuilder(study, grain).make(budget);
}

}  // namespace repose::calibrate
