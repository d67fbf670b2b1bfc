#include "calibrate/result/result_of.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "base/input_error.h"
#include "calibrate/experiment/run_result.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/solution.h"
#include "calibrate/result/result.h"
#include "calibrate/result/result_text.h"
#include "calibrate/statistics/summary.h"
#include "calibrate/study/study_simulator.h"
#include "dem/contact/model_names.h"
#include "dem/experiment/experiment_table.h"
#include "dem/study/held_inputs.h"

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

std::string text_of(const HeapDefinition& definition) {
  const base::AngleDefinition* known = base::find_definition(definition.name);
  return fmt::format("{} ({}){}", definition.name,
                     known != nullptr ? known->description : "unknown to this version",
                     definition.is_assumed ? ", which is assumed: the study does not say" : "");
}

std::string simulated_text(const HeapDefinition& definition) {
  double used_deg = NAN;
  for (const auto& [name, angle_deg] : definition.simulated_deg) {
    if (name == definition.name) used_deg = angle_deg;
  }
  if (!std::isfinite(used_deg)) return {};
  std::string others;
  for (const auto& [name, angle_deg] : definition.simulated_deg) {
    if (name == definition.name) continue;
    others +=
        fmt::format("{}{} {:+.2f}", others.empty() ? "; by " : ", ", name, angle_deg - used_deg);
  }
  return fmt::format("{:.2f} degrees by it{}", used_deg, others);
}

namespace {

/// Curves and surfaces are only drawn: six digits are enough.
void round_for_drawing(std::vector<double>& values) {
  for (double& value : values) value = std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

std::vector<ResultParameter> parameters_of(const Problem& problem, const JointFit& fit) {
  std::vector<ResultParameter> parameters;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const Parameter& sought = problem.parameters[k];
    parameters.push_back({fit.parameters[k],
                          {sought.min, sought.max},
                          sought.prior,
                          sought.useful_half_width,
                          sought.bounds_are});
  }
  return parameters;
}

std::vector<ResultObservable> observables_of(const Problem& problem, const JointFit& fit) {
  std::vector<ResultObservable> observables;
  for (std::size_t k = 0; k < fit.observables.size(); ++k) {
    observables.push_back({fit.observables[k], {}, {}});
    for (const SystematicPart& part : problem.observables[k].systematic) {
      observables.back().systematic.emplace_back(part.name, part.sd);
    }
  }
  return observables;
}

OverallAgreement agreement_of(const StudyOutcome& outcome) {
  return {.text = agreement_text(outcome.best, outcome.fit.freedom.degrees),
          .chance = outcome.best.chance,
          .rounds = outcome.check_rounds,
          .values = outcome.best.values};
}

/// First the simulated sets, except those that disagree with the bench; then those of the last fit
/// that are not close to a simulated one.
std::vector<EquivalentSet> family_of(const Problem& problem, const StudyOutcome& outcome) {
  std::vector<EquivalentSet> family;
  std::vector<Point> told;
  for (const auto& [check, chi2] : outcome.family) {
    told.push_back(to_unit(problem, check.values));
    if (check.verdict == AgreementVerdict::disagrees) continue;
    EquivalentSet& set = family.emplace_back();
    set.values = check.values;
    set.chi2 = chi2;
    set.verdict = check.verdict;
    for (const Agreement& agreement : check.observables) {
      set.simulated.push_back(agreement.simulated);
    }
  }
  for (const ParameterSet& set : outcome.fit.equivalence_family) {
    const Point point = to_unit(problem, set.values);
    const bool is_told = std::any_of(told.begin(), told.end(),
                                     [&](const Point& other) { return are_alike(point, other); });
    if (!is_told) family.push_back({set, std::nullopt, {}});
  }
  return family;
}

std::vector<ObservableSurface> regressions_of(const Problem& problem,
                                              const std::vector<Run>& runs) {
  std::vector<ObservableSurface> regressions;
  std::vector<Run> full_runs = runs;  // a polynomial does not model the shift of the others
  std::erase_if(full_runs, [&](const Run& run) {
    return run.job.inputs != experiment_named(problem, run.job.experiment).full;
  });
  for (const Observable& observable : problem.observables) {
    ObservableSurface& surface = regressions.emplace_back();
    surface.observable = observable.name;
    const auto report = surface_of_runs(problem, observable, full_runs);
    if (!report) continue;
    surface.regression = summary_of(*report);
    surface.regression->runs.clear();
  }
  return regressions;
}

/// For the runs of each experiment, in order of its name.
NamedValues shortest_timesteps(const std::vector<Run>& runs) {
  std::map<std::string, double> shortest;
  for (const Run& run : runs) {
    const auto step = run.readings.find("timestep_s");
    if (step == run.readings.end()) continue;
    const auto [place, is_new] = shortest.try_emplace(run.job.experiment, step->second);
    if (!is_new) place->second = std::min(place->second, step->second);
  }
  return {shortest.begin(), shortest.end()};
}

std::optional<double> size_sd_percent(const dem::Model& model) {
  if (model.size_cv == 0) return std::nullopt;
  return 100 * model.size_cv;
}

std::optional<HeapDefinition> heap_definition_of(const StudyRecord& record, const Problem& problem,
                                                 const NamedAngles& simulated_deg) {
  const dem::ExperimentEntry& entry = dem::pictured_experiment();
  const auto heap = record.study.experiments.find(&entry);
  const auto is_of_heaps = [&](const Observable& one) { return one.experiment == entry.name; };
  const bool is_used = std::ranges::any_of(problem.observables, is_of_heaps) ||
                       std::ranges::any_of(problem.held_out, is_of_heaps);
  if (heap == record.study.experiments.end() || !is_used) return std::nullopt;
  return HeapDefinition{.name = std::string(base::definition_meant(heap->second.definition)),
                        .is_assumed = is_definition_assumed(entry, heap->second),
                        .simulated_deg = simulated_deg};
}

std::optional<SimulatorFacts> simulator_of(const StudyRecord& record) {
  if (record.simulator->title().empty()) return std::nullopt;
  return SimulatorFacts{.name = record.simulator->title(),
                        .differences = record.simulator_differences};
}

Provenance provenance_of(const StudyRecord& record, const Problem& problem,
                         const std::vector<Run>& runs, const NamedAngles& heap_angles_deg) {
  const dem::Study& study = record.study;
  NamedValues stiffness;
  for (const Experiment& experiment : problem.experiments) {
    const dem::Experiment simulated = &dem::experiment_named(experiment.name);
    stiffness.emplace_back(experiment.name, dem::model_for(study, simulated).stiffness_factor);
  }
  return {
      .study = identity_of(record),
      .model = ModelFacts{.first_seed = study.seed,
                          .contact_model = std::string(dem::kContactModel),
                          .rolling_model = dem::name_of(study.model.rolling),
                          .rolling_definition = dem::rolling_definition(study.model.rolling),
                          .damping = dem::name_of(study.model.damping),
                          .damping_definition = dem::damping_definition(study.model),
                          .clump = {.source = record.grain.source,
                                    .spheres = record.grain.shape.spheres.size(),
                                    .volume_error = record.grain.errors.volume_error,
                                    .inertia_error = record.grain.errors.inertia_error,
                                    .size_sd_percent = size_sd_percent(study.model)},
                          .stiffness_factor = stiffness,
                          .shortest_timestep_s = shortest_timesteps(runs),
                          .heap_definition = heap_definition_of(record, problem, heap_angles_deg),
                          .simulator = simulator_of(record)},
      .assumed = study.assumed};
}

PublishedVerification verification_of(const PublishedOutcome& outcome) {
  PublishedVerification verification{.heaps = outcome.verification,
                                     .mean_deg = {},
                                     .sd_deg = {},
                                     .measured_deg = outcome.measured_angle_deg};
  std::vector<double> angles;
  for (const PublishedHeap& heap : outcome.verification) {
    if (heap.angle_deg) angles.push_back(*heap.angle_deg);
  }
  if (angles.empty()) return verification;
  const Summary summary = summarise(angles);
  verification.mean_deg = summary.mean;
  verification.sd_deg = summary.sd;
  return verification;
}

}  // namespace

JointResult fitted_result(const Problem& problem, const JointFit& fit,
                          const std::vector<Run>& runs) {
  JointResult joint{.parameters = parameters_of(problem, fit),
                    .observables = observables_of(problem, fit),
                    .verdict = {},
                    .agreement = {.text = {}, .chance = std::nan(""), .rounds = 0, .values = {}},
                    .held_out = {},
                    .stiffness_checks = {},
                    .stiffer_coefficients = {},
                    .shape_check = {},
                    .assumed_inputs = {},
                    .with_assumed = {},
                    .inputs_taken_as_exact = {},
                    .chi2 = fit.chi2,
                    .degrees_of_freedom = fit.freedom.degrees,
                    .model_error_scale = fit.model_error_scale,
                    .correlation = fit.correlation,
                    .reading_correlation = fit.reading_correlation,
                    .bench_correlation = fit.bench_correlation,
                    .equivalence_family = {},
                    .additions = fit.additions,
                    .candidates = {},
                    .warnings = {},
                    .surrogates = fit.surrogates,
                    .rounds = fit.rounds,
                    .responses = fit.curves,
                    .surfaces = fit.surfaces,
                    .regressions = regressions_of(problem, runs),
                    .runs = runs};
  for (const ParameterSet& set : fit.equivalence_family) {
    joint.equivalence_family.push_back({set, std::nullopt, {}});
  }
  for (SurrogateQuality& surrogate : joint.surrogates) {
    surrogate.warp = 0;
    surrogate.length_scales.clear();
  }
  for (ResponseCurve& curve : joint.responses) {
    for (auto* values : {&curve.simulated, &curve.uncertainty, &curve.scatter}) {
      round_for_drawing(*values);
    }
  }
  for (ResponseSurface& surface : joint.surfaces) {
    for (std::vector<double>& row : surface.simulated) round_for_drawing(row);
  }
  return joint;
}

StudyResult result_of(const StudyRecord& record, const StudyProblem& problem,
                      const StudyOutcome& outcome) {
  const JointFit& fit = outcome.fit;
  JointResult joint = fitted_result(problem.problem, fit, outcome.runs);
  for (std::size_t k = 0; k < joint.observables.size(); ++k) {
    joint.observables[k].verification = outcome.best.observables[k];
    joint.observables[k].surrogate = outcome.surrogates[k];
  }
  joint.verdict = outcome.best.verdict;
  joint.agreement = agreement_of(outcome);
  joint.held_out = outcome.predictions;
  joint.stiffness_checks = outcome.stiffness.readings;
  joint.stiffer_coefficients = outcome.stiffness.coefficients;
  joint.shape_check = outcome.shape;
  joint.assumed_scatters = outcome.assumed_scatters;
  joint.assumed_inputs = outcome.inputs;
  joint.with_assumed = outcome.combined;
  if (!outcome.inputs.empty()) {
    joint.inputs_taken_as_exact = dem::inputs_taken_as_exact(record.study);
  }
  joint.equivalence_family = family_of(problem.problem, outcome);
  joint.warnings = problem.notes;
  double hop_mm = 0;
  for (const Run& run : outcome.runs) {
    const auto hop = run.readings.find("hop_mm");
    if (hop != run.readings.end()) hop_mm = std::max(hop_mm, hop->second);
  }
  for (std::string warning :
       {dem::warning_of_shape(record.grain),
        warning_of_hops(record.study.model.rolling, record.grain.shape, hop_mm)}) {
    if (!warning.empty()) joint.warnings.push_back(std::move(warning));
  }
  for (const auto* more : {&outcome.notes, &fit.warnings}) {
    joint.warnings.insert(joint.warnings.end(), more->begin(), more->end());
  }
  return {
      .provenance = provenance_of(record, problem.problem, outcome.runs, outcome.heap_angles_deg),
      .found = std::move(joint)};
}

StudyResult result_of(const StudyRecord& record, const StudyProblem& problem,
                      const PublishedOutcome& outcome) {
  PublishedResult published{.values = {},
                            .sweeps = outcome.sweeps,
                            .steepest_ascent = outcome.ascent,
                            .composite = outcome.composite,
                            .error_surface = summary_of(outcome.surface),
                            .least_error_percent = outcome.surface.extremes.least.value,
                            .verification = verification_of(outcome),
                            .warnings = outcome.surface.diagnostics};
  for (std::size_t k = 0; k < outcome.values.size(); ++k) {
    published.values.emplace_back(problem.problem.parameters[k].name, outcome.values[k]);
  }
  if (std::string shape = dem::warning_of_shape(record.grain); !shape.empty()) {
    published.warnings.push_back({.code = "shape", .message = std::move(shape)});
  }
  published.error_surface.runs.clear();  // they are the composite design
  return {.provenance = provenance_of(record, problem.problem, {}, outcome.heap_angles_deg),
          .found = std::move(published)};
}

StudyResult result_of(const StudyRecord& record, const StudyProblem& problem,
                      const ProvisionalOutcome& outcome) {
  JointResult joint = fitted_result(problem.problem, outcome.fit, outcome.runs);
  joint.provisional = fmt::format("interrupted in \"{}\", with {} simulations in the fit",
                                  outcome.stage, outcome.runs.size());
  joint.agreement.text = "the study was interrupted before its last check";
  joint.warnings = problem.notes;
  joint.warnings.insert(joint.warnings.end(), outcome.fit.warnings.begin(),
                        outcome.fit.warnings.end());
  return {.provenance = provenance_of(record, problem.problem, outcome.runs, {}),
          .found = std::move(joint)};
}

bool is_provisional(const StudyResult& result) {
  const auto* joint = std::get_if<JointResult>(&result.found);
  return joint != nullptr && !joint->provisional.empty();
}

}  // namespace repose::calibrate
