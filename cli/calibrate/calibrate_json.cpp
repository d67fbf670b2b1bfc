#include "cli/calibrate/calibrate_json.h"

#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/version.h"
#include "calibrate/study/study_simulator.h"
#include "cli/simulate/simulate_json.h"
#include "cli/statistics/regress_json.h"
#include "cli/statistics/runs_surface.h"
#include "dem/contact/rolling_name.h"

namespace repose::cli {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no NaN: a number that does not exist is null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// What a picture shows of a curve: six digits.
std::vector<double> drawn(std::vector<double> values) {
  for (double& value : values) value = std::stod(fmt::format("{:.6g}", value));
  return values;
}

Json interval_json(const calibrate::Interval& interval) {
  return {number(interval.low), number(interval.high)};
}

Json parameters_json(const CalibratePlan& plan, const calibrate::JointFit& fit) {
  Json json = Json::array();
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const calibrate::FittedParameter& parameter = fit.parameters[k];
    const calibrate::Parameter& sought = plan.problem.problem.parameters[k];
    Json profile = Json::array();
    for (const calibrate::ProfilePoint& point : parameter.profile) {
      profile.push_back({number(point.value), number(point.chi2)});
    }
    json.push_back({{"name", parameter.name},
                    {"value", number(parameter.value)},
                    {"interval", interval_json(parameter.interval)},
                    {"verdict", name_of(parameter.verdict)},
                    {"bounds", {sought.min, sought.max}},
                    {"advice", parameter.advice},
                    {"profile", profile}});
    if (sought.prior) {
      json.back()["known_before"] = {{"mean", sought.prior->mean}, {"sd", sought.prior->sd}};
    }
  }
  return json;
}

Json observables_json(const calibrate::StudyOutcome& outcome) {
  Json json = Json::array();
  for (std::size_t k = 0; k < outcome.fit.observables.size(); ++k) {
    const calibrate::FittedObservable& observable = outcome.fit.observables[k];
    const calibrate::Agreement& checked = outcome.best.observables[k];
    json.push_back({{"name", observable.name},
                    {"unit", observable.unit},
                    {"measured", number(observable.measured)},
                    {"sd", number(observable.measured_sd)},
                    {"sd_assumed", observable.sd_assumed},
                    {"measured_uncertainty", number(observable.measured_uncertainty)},
                    {"simulated", number(observable.simulated)},
                    {"simulated_uncertainty", number(observable.simulated_uncertainty)},
                    {"simulated_sd", number(observable.simulated_sd)},
                    {"difference_sigma", number(observable.difference_sigma)},
                    {"reachable", interval_json(observable.reachable)},
                    {"verification",
                     {{"simulated", number(checked.simulated)},
                      {"uncertainty", number(checked.simulated_uncertainty)},
                      {"difference_sigma", number(checked.difference_sigma)},
                      {"runs", checked.runs},
                      {"failed_runs", checked.failed_runs}}}});
  }
  return json;
}

Json named_values(const calibrate::JointFit& fit, const std::vector<double>& values) {
  Json json = Json::object();
  for (std::size_t k = 0; k < values.size(); ++k) json[fit.parameters[k].name] = number(values[k]);
  return json;
}

Json family_json(const calibrate::StudyOutcome& outcome) {
  Json json = Json::array();
  const auto& family = outcome.fit.equivalence_family;
  for (std::size_t k = 0; k < family.size(); ++k) {
    Json set{{"parameters", named_values(outcome.fit, family[k].values)},
             {"chi2_above_best", number(family[k].chi2)},
             {"verified", nullptr}};
    if (k < outcome.family.size()) {
      set["verified"] = outcome.family[k].agrees;
      for (const calibrate::Agreement& agreement : outcome.family[k].observables) {
        set["simulated"][agreement.observable] = number(agreement.simulated);
      }
    }
    json.push_back(set);
  }
  return json;
}

Json surrogates_json(const calibrate::JointFit& fit) {
  Json json = Json::array();
  for (const calibrate::SurrogateQuality& surrogate : fit.surrogates) {
    json.push_back({{"observable", surrogate.observable},
                    {"runs", surrogate.runs},
                    {"failed_runs", surrogate.failed_runs},
                    {"leave_one_out_error", number(surrogate.leave_one_out_error)},
                    {"leave_one_out_sigma", number(surrogate.leave_one_out_sigma)},
                    {"inflation", number(surrogate.inflation)}});
  }
  return json;
}

Json rounds_json(const calibrate::JointFit& fit) {
  Json json = Json::array();
  for (const calibrate::RoundSummary& round : fit.rounds) {
    json.push_back({{"round", round.round},
                    {"jobs", round.jobs},
                    {"estimated_core_s", round.seconds},
                    {"values", named_values(fit, round.values)},
                    {"sd", named_values(fit, round.sd)}});
  }
  return json;
}

Json responses_json(const calibrate::JointFit& fit) {
  Json json = Json::array();
  for (const calibrate::ResponseCurve& curve : fit.curves) {
    json.push_back({{"observable", fit.observables[curve.observable].name},
                    {"parameter", fit.parameters[curve.parameter].name},
                    {"values", curve.values},
                    {"simulated", drawn(curve.simulated)},
                    {"uncertainty", drawn(curve.uncertainty)},
                    {"scatter", drawn(curve.scatter)}});
  }
  return json;
}

Json surfaces_json(const calibrate::JointFit& fit) {
  Json json = Json::array();
  for (const calibrate::ResponseSurface& surface : fit.surfaces) {
    Json rows = Json::array();
    for (const std::vector<double>& row : surface.simulated) rows.push_back(drawn(row));
    json.push_back({{"observable", fit.observables[surface.observable].name},
                    {"x_parameter", fit.parameters[surface.x_parameter].name},
                    {"y_parameter", fit.parameters[surface.y_parameter].name},
                    {"x", surface.x},
                    {"y", surface.y},
                    {"simulated", rows}});
  }
  return json;
}

Json runs_json(const calibrate::StudyOutcome& outcome) {
  Json json = Json::array();
  for (const calibrate::Run& run : outcome.runs) {
    json.push_back({{"experiment", run.job.experiment},
                    {"seed", run.job.seed},
                    {"values", named_values(outcome.fit, run.job.values)},
                    {"readings", run.readings},
                    {"failure", run.failure.empty() ? Json(nullptr) : Json(run.failure)}});
  }
  return json;
}

/// A polynomial through the runs of each observable, with its analysis of variance: what a
/// response-surface program would say of them. Null where there are too few runs for one.
Json regressions_json(const CalibratePlan& plan, const calibrate::StudyOutcome& outcome) {
  Json json = Json::array();
  for (const calibrate::Observable& observable : plan.problem.problem.observables) {
    const auto report = surface_of_runs(plan.problem.problem, observable, outcome.runs);
    Json regression = report ? Json::parse(regress_json(*report)) : Json(nullptr);
    if (report) regression.erase("runs");
    json.push_back({{"observable", observable.name}, {"regression", regression}});
  }
  return json;
}

/// Shortest time step that an experiment's runs had.
Json timesteps_json(const std::vector<calibrate::Run>& runs) {
  std::map<std::string, double> shortest;
  for (const calibrate::Run& run : runs) {
    const auto step = run.readings.find("timestep_s");
    if (step == run.readings.end()) continue;
    const auto [place, is_new] = shortest.try_emplace(run.job.experiment, step->second);
    if (!is_new) place->second = std::min(place->second, step->second);
  }
  return shortest;
}

/// All that the coefficients belong to.
Json provenance_json(const CalibratePlan& plan, const std::vector<calibrate::Run>& runs) {
  const dem::Study& study = plan.record.study;
  Json stiffness = Json::object();
  for (const calibrate::Experiment& experiment : plan.problem.problem.experiments) {
    stiffness[experiment.name] =
        dem::model_for(study, dem::experiment_named(experiment.name).experiment).stiffness_factor;
  }
  return {{"program", base::kProgram},
          {"study",
           {{"file", study.file.filename().string()},
            {"hash", study.hash},
            {"settings", plan.record.settings}}},
          {"budget",
           {{"name", plan.record.budget.name}, {"description", plan.record.budget.description}}},
          {"first_seed", study.seed},
          {"contact_model", contact_model_text()},
          {"rolling_model", dem::name_of(study.model.rolling)},
          {"rolling_definition", rolling_definition(study.model.rolling)},
          {"clump",
           {{"source", plan.record.grain.source},
            {"spheres", plan.record.grain.shape.spheres.size()},
            {"volume_error", plan.record.grain.errors.volume_error},
            {"inertia_error", plan.record.grain.errors.inertia_error}}},
          {"stiffness_factor", stiffness},
          {"shortest_timestep_s", timesteps_json(runs)}};
}

}  // namespace

std::string name_of(calibrate::Verdict verdict) {
  switch (verdict) {
    case calibrate::Verdict::determined:
      return "determined";
    case calibrate::Verdict::one_sided:
      return "one-sided";
    case calibrate::Verdict::undetermined:
      break;
  }
  return "undetermined";
}

std::string calibrate_json(const CalibratePlan& plan, const calibrate::StudyOutcome& outcome) {
  const calibrate::JointFit& fit = outcome.fit;
  std::vector<std::string> warnings = plan.problem.notes;
  warnings.insert(warnings.end(), outcome.notes.begin(), outcome.notes.end());
  warnings.insert(warnings.end(), fit.warnings.begin(), fit.warnings.end());
  Json json{{"method", plan.record.method},
            {"parameters", parameters_json(plan, fit)},
            {"observables", observables_json(outcome)},
            {"verified", outcome.best.agrees},
            {"chi2", number(fit.chi2)},
            {"correlation", fit.correlation},
            {"equivalence_family", family_json(outcome)},
            {"warnings", warnings},
            {"surrogates", surrogates_json(fit)},
            {"rounds", rounds_json(fit)},
            {"responses", responses_json(fit)},
            {"surfaces", surfaces_json(fit)},
            {"provenance", provenance_json(plan, outcome.runs)},
            {"regressions", regressions_json(plan, outcome)},
            {"runs", runs_json(outcome)}};
  // Names of files need not be UTF-8, JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

namespace {

/// "quick", "paper_quick"
std::string way_of(const std::string& method, const std::string& budget) {
  return method == "joint" ? budget : method + '_' + budget;
}

}  // namespace

std::string provenance_text(const CalibratePlan& plan) { return provenance_json(plan, {}).dump(); }

std::string name_when_set_aside(const std::string& old_json, const CalibratePlan& plan) {
  const Json old = Json::parse(old_json, nullptr, false);
  try {
    const Json& provenance = old.at("provenance");
    const std::string hash = provenance.at("study").at("hash");
    const std::string way =
        way_of(old.value("method", "joint"), provenance.at("budget").at("name"));
    if (hash == plan.record.study.hash &&
        way == way_of(plan.record.method, plan.record.budget.name))
      return {};
    return fmt::format("result_{}_{}.json", way, hash.substr(0, hash.find('-')));
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

}  // namespace repose::cli
