#pragma once

#include "calibrate/experiment/json_fields.h"
#include "calibrate/result/provenance_fields.h"
#include "calibrate/result/result.h"
#include "calibrate/result/surface_fields.h"

/// Names of a result's fields in result.json.
namespace repose::calibrate {

template <>
inline constexpr bool kIsPair<Interval> = true;
template <>
inline constexpr bool kIsPair<ProfilePoint> = true;

inline constexpr const auto& names_for(Verdict) { return kVerdictNames; }
inline constexpr const auto& names_for(AgreementVerdict) { return kAgreementNames; }
inline constexpr const auto& names_for(BoundsOrigin) { return kBoundsNames; }
inline constexpr const auto& names_for(MarginSource) { return kMarginNames; }

template <typename Io>
void fields(Io& io, Held<Io, Prior>& prior) {
  io("mean", prior.mean);
  io("sd", prior.sd);
}

template <typename Io>
void fields(Io& io, Held<Io, Narrowing>& narrowing) {
  if (io.has("hour", narrowing.hour.has_value())) io("hour", narrowing.hour);
  io("exact", narrowing.exact);
  io("readings", narrowing.readings);
}

template <typename Io>
void fields(Io& io, Held<Io, ResultParameter>& parameter) {
  io("name", parameter.name);
  io("value", parameter.value);
  io("interval", parameter.interval);
  io("verdict", parameter.verdict);
  io("bounds", parameter.bounds);
  io("advice", parameter.advice);
  io("profile", parameter.profile);
  if (io.has("known_before", parameter.known_before.has_value())) {
    io("known_before", parameter.known_before);
  }
  if (io.has("useful_half_width", parameter.useful_half_width.has_value())) {
    io("useful_half_width", parameter.useful_half_width);
  }
  if (io.has("bounds_are", parameter.bounds_are.has_value())) {
    io("bounds_are", parameter.bounds_are);
  }
  if (io.has("narrowing", parameter.narrowing.has_value())) io("narrowing", parameter.narrowing);
}

template <typename Io>
void fields(Io& io, Held<Io, Agreement>& check) {
  io("verdict", check.verdict);
  io("simulated", check.simulated);
  io("uncertainty", check.simulated_uncertainty);
  io("difference_sigma", check.difference_sigma);
  io("p", check.chance);
  io("tolerance", check.tolerance);
  if (io.has("tolerance_from", check.tolerance_from.has_value())) {
    io("tolerance_from", check.tolerance_from);
  }
  io("difference_90", check.difference);
  io("detectable", check.detectable);
  io("runs_to_decide", check.runs_to_decide);
  if (io.has("readings_to_decide", check.tolerance_from.has_value())) {
    io("readings_to_decide", check.readings_to_decide);
  }
  io("runs", check.runs);
  io("failed_runs", check.failed_runs);
}

template <typename Io>
void fields(Io& io, Held<Io, SurrogateCheck>& check) {
  io("predicted", check.predicted);
  io("uncertainty", check.uncertainty);
  io("p", check.chance);
  io("misses", check.misses);
}

template <typename Io>
void fields(Io& io, Held<Io, OverallAgreement>& agreement) {
  io("text", agreement.text);
  io("p", agreement.chance);
  io("rounds", agreement.rounds);
  if (io.has("checked_at", !agreement.values.empty())) {
    by_name(io, "checked_at", io.names().parameters, agreement.values);
  }
}

template <typename Io>
void fields(Io& io, Held<Io, ResultObservable>& observable) {
  io("name", observable.name);
  io("unit", observable.unit);
  io("measured", observable.measured);
  io("sd", observable.measured_sd);
  io("sd_assumed", observable.sd_assumed);
  io("measured_uncertainty", observable.measured_uncertainty);
  if (io.has("systematic_uncertainty", observable.systematic_uncertainty > 0)) {
    io("systematic_uncertainty", observable.systematic_uncertainty);
  }
  if (io.has("systematic", !observable.systematic.empty())) {
    io("systematic", observable.systematic);
  }
  if (io.has("model_uncertainty", observable.model_uncertainty > 0)) {
    io("model_uncertainty", observable.model_uncertainty);
  }
  io("simulated", observable.simulated);
  io("simulated_uncertainty", observable.simulated_uncertainty);
  io("simulated_sd", observable.simulated_sd);
  io("predicted_sd", observable.predicted_sd);
  io("difference_sigma", observable.difference_sigma);
  io("reachable", observable.reachable);
  io("verification", observable.verification);
  io("surrogate_check", observable.surrogate);
  if constexpr (Io::kReads) {
    if (observable.verification.has_value() != observable.surrogate.has_value()) {
      Io::refuse("surrogate_check", "must be there where verification is, and only there");
    }
    if (!observable.verification) return;
    observable.verification->observable = observable.surrogate->observable = observable.name;
    observable.verification->measured = observable.measured;
    observable.verification->measured_uncertainty = observable.measured_uncertainty;
    observable.surrogate->simulated = observable.verification->simulated;
  }
}

template <typename Io>
void fields(Io& io, Held<Io, Prediction>& prediction) {
  io("name", prediction.name);
  io("unit", prediction.unit);
  io("measured", prediction.measured);
  io("measured_uncertainty", prediction.measured_uncertainty);
  io("predicted", prediction.predicted);
  io("uncertainty", prediction.uncertainty);
  io("interval", prediction.interval);
  io("coefficients_sd", prediction.coefficients_sd);
  io("run_sd", prediction.run_sd);
  if (io.has("model_sd", prediction.model_sd > 0)) io("model_sd", prediction.model_sd);
  io("difference_sigma", prediction.difference_sigma);
  io("p", prediction.chance);
  io("tolerance", prediction.tolerance);
  if (io.has("tolerance_from", prediction.tolerance_from.has_value())) {
    io("tolerance_from", prediction.tolerance_from);
    io("readings_to_decide", prediction.readings_to_decide);
  }
  if (io.has("possible", prediction.possible.has_value())) io("possible", prediction.possible);
  io("sets", prediction.sets);
  io("failed_runs", prediction.failed_runs);
  io("verdict", prediction.verdict);
}

template <typename Io>
void fields(Io& io, Held<Io, SensitivityCheck>& check) {
  io("name", check.name);
  io("unit", check.unit);
  if (io.has("spheres", check.input == AssumedInput::spheres)) {
    if constexpr (Io::kReads) check.input = AssumedInput::spheres;
    io("multiple", check.multiple);
    io("spheres", check.value);
  } else {
    io("stiffness", check.multiple);
    io("stiffness_factor", check.value);
  }
  if (io.has("grain_size", check.grain_size != 1)) io("grain_size", check.grain_size);
  io("change", check.change);
  io("uncertainty", check.uncertainty);
  io("interval", check.interval);
  io("p", check.chance);
  io("limit", check.limit);
  io("runs", check.runs);
  io("failed_runs", check.failed_runs);
  io("verdict", check.verdict);
}

template <typename Io>
void fields(Io& io, Held<Io, MovedCoefficient>& coefficient) {
  io("name", coefficient.name);
  io("value", coefficient.value);
  io("interval", coefficient.interval);
  io("verdict", coefficient.verdict);
}

template <typename Io>
void fields(Io& io, Held<Io, AssumedScatter>& assumed) {
  io("observable", assumed.observable);
  io("sd_fraction", assumed.fraction);
}

template <typename Io>
void fields(Io& io, Held<Io, ScatterDependence>& coefficient) {
  io("name", coefficient.name);
  io("rests_on", coefficient.rests_on);
  io("half", coefficient.half);
  io("twice", coefficient.twice);
}

template <typename Io>
void fields(Io& io, Held<Io, AssumedScatters>& assumed) {
  io("readings", assumed.readings);
  io("coefficients", assumed.coefficients);
}

template <typename Io>
void fields(Io& io, Held<Io, ShapeCheck>& shape) {
  io("spheres", shape.spheres);
  io("finer_spheres", shape.finer_spheres);
  io("finer_volume_error", shape.finer_volume_error);
  io.text_or_null("not_made", shape.not_made);
  io("too_dear", shape.over_budget);
  io("readings", shape.readings);
  io("coefficients", shape.coefficients);
}

template <typename Io>
void fields(Io& io, Held<Io, InputChange>& change) {
  io("name", change.name);
  io("change", change.change);
  io("uncertainty", change.uncertainty);
}

template <typename Io>
void fields(Io& io, Held<Io, InputEffect>& effect) {
  io("input", effect.input);
  io("unit", effect.unit);
  io("value", effect.value);
  io("sd", effect.sd);
  io("is_assumed", effect.is_assumed);
  io("readings", effect.readings);
  io("coefficients", effect.coefficients);
  io("not_varied", effect.not_varied);
}

template <typename Io>
void fields(Io& io, Held<Io, CombinedEffect>& combined) {
  io("name", combined.name);
  io("value", combined.value);
  io("effect", combined.effect);
  io("half_width", combined.half_width);
  io("interval", combined.interval);
}

template <typename Io>
void fields(Io& io, Held<Io, EquivalentSet>& set) {
  by_name(io, "parameters", io.names().parameters, set.values);
  io("chi2_above_best", set.chi2);
  io("verdict", set.verdict);
  if (io.has("simulated", !set.simulated.empty())) {
    by_name(io, "simulated", io.names().observables, set.simulated);
  }
}

template <typename Io>
void fields(Io& io, Held<Io, StudyAddition>& addition) {
  io("experiment", addition.experiment);
  io("lines", addition.lines);
}

template <typename Io>
void fields(Io& io, Held<Io, Candidate>& candidate) {
  io("name", candidate.name);
  io("score_of_means", candidate.means);
  io("score_of_scatter", candidate.scatter);
  io("verdict", candidate.verdict);
  io("values", candidate.values);
}

template <typename Io>
void fields(Io& io, Held<Io, CoarseQuality>& coarse) {
  io("size", coarse.size);
  io("runs", coarse.runs);
  io("failed_runs", coarse.failed_runs);
  io("shift", coarse.shift);
  io("shift_uncertainty", coarse.uncertainty);
  io("scatter", coarse.scatter);
}

template <typename Io>
void fields(Io& io, Held<Io, SurrogateQuality>& surrogate) {
  io("observable", surrogate.observable);
  io("runs", surrogate.runs);
  io("failed_runs", surrogate.failed_runs);
  io("leave_one_out_error", surrogate.leave_one_out_error);
  io("leave_one_out_sigma", surrogate.leave_one_out_sigma);
  io("inflation", surrogate.inflation);
  if (io.has("full_size", surrogate.full_size != 1)) io("full_size", surrogate.full_size);
  if (io.has("coarse", surrogate.coarse.has_value())) io("coarse", surrogate.coarse);
}

template <typename Io>
void fields(Io& io, Held<Io, RoundSummary>& round) {
  io("round", round.round);
  io("jobs", round.jobs);
  io("estimated_core_s", round.seconds);
  by_name(io, "values", io.names().parameters, round.values);
  by_name(io, "sd", io.names().parameters, round.sd);
}

template <typename Io>
void fields(Io& io, Held<Io, ResponseCurve>& curve) {
  io.place("observable", io.names().observables, curve.observable);
  io.place("parameter", io.names().parameters, curve.parameter);
  io("values", curve.values);
  io("simulated", curve.simulated);
  io("uncertainty", curve.uncertainty);
  io("scatter", curve.scatter);
}

template <typename Io>
void fields(Io& io, Held<Io, ResponseSurface>& surface) {
  io.place("observable", io.names().observables, surface.observable);
  io.place("x_parameter", io.names().parameters, surface.x_parameter);
  io.place("y_parameter", io.names().parameters, surface.y_parameter);
  io("x", surface.x);
  io("y", surface.y);
  io("simulated", surface.simulated);
}

template <typename Io>
void fields(Io& io, Held<Io, ObservableSurface>& surface) {
  io("observable", surface.observable);
  io("regression", surface.regression);
}

template <typename Io>
void fields(Io& io, Held<Io, Run>& run) {
  io("experiment", run.job.experiment);
  io("seed", run.job.seed);
  by_name(io, "values", io.names().parameters, run.job.values);
  io("readings", run.readings);
  io.text_or_null("failure", run.failure);
  if (io.has("repeats", run.repeats > 1)) {
    io("repeats", run.repeats);
    io("repeat_sd", run.repeat_sd);
  }
  if (io.has("reading_sd", !run.reading_sd.empty())) io("reading_sd", run.reading_sd);
  if (io.has("size", run.job.inputs.size != 1)) io("size", run.job.inputs.size);
}

template <typename Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

template <typename Io>
void joint_fields(Io& io, Held<Io, JointResult>& joint, Held<Io, Provenance>& provenance) {
  if (io.has("provisional", !joint.provisional.empty())) io("provisional", joint.provisional);
  io("parameters", joint.parameters);
  io("observables", joint.observables);
  io.names() = {names_of(joint.parameters), names_of(joint.observables), {}};
  io("verdict", joint.verdict);
  io("agreement", joint.agreement);
  if (io.has("held_out", !joint.held_out.empty())) io("held_out", joint.held_out);
  if (io.has("stiffness_checks", !joint.stiffness_checks.empty())) {
    io("stiffness_checks", joint.stiffness_checks);
  }
  if (io.has("stiffer_coefficients", !joint.stiffer_coefficients.empty())) {
    io("stiffer_coefficients", joint.stiffer_coefficients);
  }
  if (io.has("shape_check", joint.shape_check.has_value())) {
    io("shape_check", joint.shape_check);
  }
  if (io.has("assumed_scatter", !joint.assumed_scatters.readings.empty())) {
    io("assumed_scatter", joint.assumed_scatters);
  }
  if (io.has("assumed_inputs", !joint.assumed_inputs.empty())) {
    io("assumed_inputs", joint.assumed_inputs);
    io("with_assumed", joint.with_assumed);
    io("inputs_taken_as_exact", joint.inputs_taken_as_exact);
  }
  io("chi2", joint.chi2);
  if (io.has("degrees_of_freedom", joint.degrees_of_freedom.has_value())) {
    io("degrees_of_freedom", joint.degrees_of_freedom);
  }
  if (io.has("model_error_scale", joint.model_error_scale.has_value())) {
    io("model_error_scale", joint.model_error_scale);
  }
  io("correlation", joint.correlation);
  io("reading_correlation", joint.reading_correlation);
  if (io.has("bench_correlation", !joint.bench_correlation.empty())) {
    io("bench_correlation", joint.bench_correlation);
  }
  io("equivalence_family", joint.equivalence_family);
  if (io.has("additions", !joint.additions.empty())) io("additions", joint.additions);
  if (io.has("candidates", !joint.candidates.empty())) io("candidates", joint.candidates);
  io("warnings", joint.warnings);
  io("surrogates", joint.surrogates);
  io("rounds", joint.rounds);
  io("responses", joint.responses);
  io("surfaces", joint.surfaces);
  io("provenance", provenance);
  io("regressions", joint.regressions);
  io("runs", joint.runs);
}

template <typename Io>
void fields(Io& io, Held<Io, PublishedSweep>& sweep) {
  io("parameter", sweep.parameter);
  io("observable", sweep.observable);
  io("measured", sweep.measured);
  io("levels", sweep.levels);
  io("results", sweep.results);
  io("value", sweep.value);
  io("reached", sweep.is_reached);
  io("r2", sweep.r2);
}

template <typename Io>
void fields(Io& io, Held<Io, PublishedHeap>& heap) {
  spread(io, {"restitution", "sliding_friction", "rolling_friction"}, heap.coefficients);
  io("angle_deg", heap.angle_deg);
  io("error_percent", heap.error_percent);
}

template <typename Io>
void fields(Io& io, Held<Io, PublishedVerification>& verification) {
  io("heaps", verification.heaps);
  io("mean_deg", verification.mean_deg);
  io("sd_deg", verification.sd_deg);
  io("measured_deg", verification.measured_deg);
}

template <typename Io>
void published_fields(Io& io, Held<Io, PublishedResult>& published,
                      Held<Io, Provenance>& provenance) {
  io("values", published.values);
  io("sweeps", published.sweeps);
  io("steepest_ascent", published.steepest_ascent);
  io("composite", published.composite);
  io("error_surface", published.error_surface);
  io("least_error_percent", published.least_error_percent);
  io("verification", published.verification);
  io("warnings", published.warnings);
  io("provenance", provenance);
}

}  // namespace repose::calibrate
