// Writes a result.json with everything a report can show, and names that try to be markup, and, if
// asked, a run with such a name:
// made_up_result RESULT.json [RUN.json]
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "calibrate/experiment/run_result.h"
#include "calibrate/result/result.h"

namespace repose::calibrate {
namespace {

const std::string kHostile =
    "\"'><script>window.hacked = 1</script><img src=x onerror=\"window.hacked = 2\">";
const std::string kLong(10'000, 'x');
constexpr double kLow = .1, kHigh = .9;

/// A measured reading and the coefficients that affect it.
struct Made {
  std::string name;
  std::string unit;
  double measured = 0;
  std::vector<std::size_t> moves;
};

const std::vector<Made> kMade = {{"drop", "mm", 9.4, {0}},
                                 {"heap", "deg", 23.4, {0, 1, 2, 3, 4, 5}},
                                 {"heap." + kHostile, "mm", 120, {4, 5}}};

const std::vector<std::string> kNames = {"contact.particle_wall.restitution",
                                         "contact.particle_wall.sliding_friction",
                                         "contact.particle_wall.rolling_friction",
                                         "contact.particle_particle.restitution",
                                         "contact." + kHostile,
                                         "contact.particle_particle." + kLong};
const std::vector<double> kBest(kNames.size(), .5);

std::vector<double> steps(int count, double from, double to) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(from + (to - from) * k / (count - 1));
  return values;
}

double simulated(const Made& made, const std::vector<double>& values) {
  double product = made.measured;
  for (const std::size_t k : made.moves) product *= .6 + .8 * values[k];
  return product;
}

std::vector<ResultParameter> parameters() {
  std::vector<ResultParameter> all;
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    ResultParameter& parameter = all.emplace_back();
    parameter.name = kNames[k];
    parameter.value = .5;
    parameter.interval = {.4, k < 3 ? .6 : .9};
    parameter.verdict = kVerdictNames.at(k % kVerdictNames.size()).first;
    parameter.bounds = {kLow, kHigh};
    if (k > 2) parameter.advice = "measure " + kHostile;
    for (const double x : steps(9, kLow, kHigh)) {
      parameter.profile.push_back({x, 60 * (x - .5) * (x - .5)});
    }
  }
  return all;
}

ResultObservable observable(const Made& made) {
  const double measured = made.measured;
  return {{.name = made.name,
           .unit = made.unit,
           .measured = measured,
           .measured_sd = .1 * measured,
           .sd_assumed = true,
           .measured_uncertainty = .03 * measured,
           .simulated = measured,
           .simulated_uncertainty = .02 * measured,
           .simulated_sd = .05 * measured,
           .predicted_sd = .1 * measured,
           .difference_sigma = 0,
           .reachable = {.1 * measured, 3 * measured}},
          Agreement{.observable = made.name,
                    .measured = measured,
                    .measured_uncertainty = .03 * measured,
                    .simulated = measured,
                    .simulated_uncertainty = .1,
                    .difference_sigma = .2,
                    .chance = .8,
                    .tolerance = .05 * measured,
                    .difference = {-1, 1},
                    .detectable = .1 * measured,
                    .runs_to_decide = {},
                    .verdict = AgreementVerdict::agrees,
                    .runs = 3,
                    .failed_runs = 0},
          SurrogateCheck{.observable = made.name,
                         .predicted = measured,
                         .uncertainty = .1,
                         .simulated = measured,
                         .chance = .7,
                         .misses = false}};
}

void add_responses(std::size_t observable, JointResult& joint) {
  const Made& made = kMade[observable];
  for (const std::size_t k : made.moves) {
    ResponseCurve curve{observable,     k, steps(41, kLow, kHigh), {}, steps(41, .5, 1),
                        steps(41, 1, 2)};
    std::vector<double> values = kBest;
    for (const double x : curve.values) {
      values[k] = x;
      curve.simulated.push_back(simulated(made, values));
    }
    joint.responses.push_back(curve);
    for (const std::size_t other : made.moves) {
      if (other <= k) continue;
      ResponseSurface surface{observable, k, other, steps(21, kLow, kHigh), steps(21, kLow, kHigh),
                              {}};
      for (const double y : surface.y) {
        auto& row = surface.simulated.emplace_back();
        values[other] = y;
        for (const double x : surface.x) {
          values[k] = x;
          row.push_back(simulated(made, values));
        }
      }
      values = kBest;
      joint.surfaces.push_back(surface);
    }
  }
}

SurfaceSummary regression(const Made& made) {
  const Variance variance{.sum_of_squares = 12.5, .df = 3, .f = 9.3, .p = .001};
  const std::vector<double> centre(made.moves.size(), .5);
  SurfaceSummary surface;
  surface.response = made.name;
  for (const std::size_t k : made.moves) {
    surface.factors.push_back({{kNames[k], kLow, kHigh}, {kLow, kHigh}, variance});
  }
  for (const std::string& term : {std::string("1"), kHostile}) {
    SurfaceTerm& made_up = surface.coefficients.emplace_back();
    made_up.term = term;
    made_up.value = 2;
    made_up.p = .05;
  }
  surface.anova.model = surface.anova.residual = surface.anova.total = variance;
  surface.extremes = {{centre, centre, 1, .1}, {centre, centre, 2, .1}};
  surface.warnings = {{"x", kHostile}};
  return surface;
}

std::vector<Run> runs() {
  constexpr int kRuns = 60;
  std::vector<Run> all;
  for (int k = 0; k < kRuns; ++k) {
    const Made& made = kMade[static_cast<std::size_t>(k % 2)];
    Run& run = all.emplace_back();
    run.job.experiment = made.name;
    run.job.seed = static_cast<std::uint64_t>(k);
    for (std::size_t p = 0; p < kNames.size(); ++p) {
      run.job.values.push_back(kLow + .8 * std::fmod(k * static_cast<double>(p + 1) * .618, 1));
    }
    if (k == 7) run.failure = kHostile;
    if (k != 7) run.readings["value"] = simulated(made, run.job.values);
  }
  return all;
}

JointResult joint() {
  JointResult joint;
  joint.parameters = parameters();
  joint.verdict = AgreementVerdict::agrees;
  joint.agreement = {"agrees with " + kHostile, .5, 1, kBest};
  for (std::size_t k = 0; k < kMade.size(); ++k) {
    joint.observables.push_back(observable(kMade[k]));
    add_responses(k, joint);
    joint.regressions.push_back({kMade[k].name, regression(kMade[k])});
    SurrogateQuality& surrogate = joint.surrogates.emplace_back();
    surrogate.observable = kMade[k].name;
  }
  joint.correlation.assign(kNames.size(), std::vector<double>(kNames.size(), .2));
  joint.reading_correlation = {{1, 0, 0}, {0, 1, -.7}, {0, -.7, 1}};
  joint.additions.push_back({.experiment = kHostile, .lines = "[experiment]\n" + kHostile});
  for (const double value : {.3, .6, .8}) {
    EquivalentSet& set = joint.equivalence_family.emplace_back();
    set.values.assign(kNames.size(), value);
    set.chi2 = 1;
    set.verdict = AgreementVerdict::agrees;
    set.simulated.assign(kMade.size(), 9);
  }
  for (int round = 0; round < 3; ++round) {
    joint.rounds.push_back({round, 20 * (round + 1), 100, kBest,
                            std::vector<double>(kNames.size(), .2 / (round + 1))});
  }
  joint.warnings = {kHostile, "the budget was small"};
  joint.runs = runs();
  return joint;
}

StudyResult result() {
  StudyResult result;
  result.provenance = {
      .study = {.program = "repose 0",
                .file = kHostile,
                .hash = "abc",
                .settings = {kHostile},
                .method = "joint",
                .budget = "quick",
                .budget_description = kHostile},
      .model = ModelFacts{.first_seed = 1,
                          .contact_model = "Hertz-Mindlin (no slip)",
                          .rolling_model = "constant_torque",
                          .rolling_definition = "mu_r F_n times x",
                          .clump = {kLong, 11, .01, .001},
                          .stiffness_factor = {{"drop", 1}, {"heap", .01}},
                          .shortest_timestep_s = {{"drop", 1e-6}, {"heap", 1e-5}}}};
  result.found = joint();
  return result;
}

RunResult run() {
  const nlohmann::json description = {{"experiment", kHostile},
                                      {"particle_wall", {{"restitution", .1}}}};
  RunResult run;
  run.simulated = description.dump();
  run.value = 1;
  run.timestep_s = 1e-6;
  run.readings = {{"sd_mm", std::nullopt}};
  return run;
}

}  // namespace
}  // namespace repose::calibrate

int main(int count, char* arguments[]) {
  if (count < 2 || count > 3) return 2;
  std::ofstream(arguments[1]) << to_json(repose::calibrate::result());
  if (count == 3) std::ofstream(arguments[2]) << text_of(repose::calibrate::run());
  return 0;
}
