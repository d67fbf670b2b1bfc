#include "tests/calibrate/made_up_result.h"

namespace repose::calibrate::test {
namespace {

constexpr const char* kRestitution = "contact.particle_wall.restitution";
constexpr const char* kSliding = "contact.particle_wall.sliding_friction";

Provenance provenance(const std::string& method) {
  return {.study = {.program = "repose 0",
                    .file = "nuts.toml",
                    .hash = "abc-1",
                    .settings = {"a.b=1"},
                    .method = method,
                    .budget = "standard",
                    .budget_description = "long"},
          .model = ModelFacts{.first_seed = 7,
                              .contact_model = "Hertz-Mindlin (no slip)",
                              .rolling_model = "constant_torque",
                              .rolling_definition = "mu_r F_n times x",
                              .clump = {.source = "nut.stl",
                                        .spheres = 11,
                                        .volume_error = .01,
                                        .inertia_error = .02,
                                        .size_sd_percent = 4.3},
                              .stiffness_factor = {{"drop", 1}, {"heap", .01}},
                              .shortest_timestep_s = {{"drop", 1e-6}},
                              .heap_definition =
                                  HeapDefinition{.name = "flank_20_80",
                                                 .is_assumed = true,
                                                 .simulated_deg = {{"flank_20_80", 23.9},
                                                                   {"whole_flank", 21.3}}}},
          .assumed = {"particle.density_kg_m3"}};
}

FittedParameter restitution() {
  return {.name = kRestitution,
          .value = .4,
          .interval = {.35, .45},
          .verdict = Verdict::determined,
          .advice = "",
          .profile = {{.3, 5}, {.4, 0}, {.5, 6}},
          .narrowing = Narrowing{.hour = .875, .exact = .75, .readings = .5}};
}

FittedParameter sliding() {
  return {.name = kSliding,
          .value = .3,
          .interval = {.1, .8},
          .verdict = Verdict::undetermined,
          .advice = "tilt a plate",
          .profile = {}};
}

FittedObservable drop() {
  return {.name = "drop",
          .unit = "mm",
          .measured = 25,
          .measured_sd = 1,
          .sd_assumed = false,
          .measured_uncertainty = .5,
          .systematic_uncertainty = .28,
          .simulated = 25.1,
          .simulated_uncertainty = .2,
          .simulated_sd = .4,
          .predicted_sd = 1.2,
          .difference_sigma = .1,
          .reachable = {1, 80}};
}

SurfacePoint point(double x, double y) {
  return {.coded = {x, y}, .natural = {.5 + x / 2, .4 + y / 4}, .value = 3, .uncertainty = .5};
}

/// In both coefficients.
SurfaceSummary surface() {
  const Variance variance{.sum_of_squares = 12.5, .df = 3, .f = 9.25, .p = .001};
  SurfaceFactor first{{.name = kRestitution, .low = 0, .high = 1}, {0, 1}, variance};
  SurfaceFactor second{{.name = kSliding, .low = .15, .high = .65}, {.15, .65}, variance};
  return {.response = "drop",
          .model = SurfaceModel::quadratic,
          .factors = {first, second},
          .coefficients = {{.term = std::string(kRestitution) + "^2",
                            .value = 20,
                            .standard_error = 1,
                            .t = 20,
                            .p = {},
                            .interval = {18, 22},
                            .partial_sum_of_squares = 4,
                            .natural = 40}},
          .anova = {.model = variance,
                    .residual = {.sum_of_squares = 1, .df = 0, .f = {}, .p = {}},
                    .lack_of_fit = variance,
                    .pure_error = {},
                    .total = variance},
          .residual_sd = .5,
          .r2 = .9,
          .r2_adjusted = .8,
          .r2_predicted = {},
          .press = 3,
          .canonical =
              CanonicalForm{.axes = {{.curvature = 2, .uncertainty = 1, .direction = {0, 1}}},
                            .stationary = point(.5, .5),
                            .is_inside = true,
                            .region = StationaryRegion{.is_in_box = true,
                                                       .ranges = {{.4, .6}, {.3, std::nullopt}}},
                            .shape = SurfaceShape::saddle},
          .extremes = {.least = point(-1, 0), .greatest = point(1, 1)},
          .target =
              SurfaceTarget{
                  .value = 25,
                  .uncertainty = 0,
                  .is_reached = true,
                  .ranges = {{{.2, .3}, {.5, .6}}, {}},
                  .through_centre = {{.factor = 1, .levels = {.5, .4}, .interval = {}}},
                  .points = {{.factor = 0, .levels = {.2, .3}, .interval = {.1, std::nullopt}}}},
          .runs = {},
          .warnings = {{.code = "ridge", .message = "a ridge"}}};
}

/// A drop with its measurement, fit and check.
ResultObservable drop_result() {
  return {drop(),
          Agreement{.observable = "drop",
                    .measured = 25,
                    .measured_uncertainty = .5,
                    .simulated = 25.4,
                    .simulated_uncertainty = .3,
                    .difference_sigma = .6,
                    .chance = .55,
                    .tolerance = 1.25,
                    .difference = {-.6, 1.4},
                    .detectable = 1.75,
                    .runs_to_decide = 7,
                    .verdict = AgreementVerdict::cannot_tell,
                    .runs = 3,
                    .failed_runs = 1},
          SurrogateCheck{.observable = "drop",
                         .predicted = 25.1,
                         .uncertainty = .2,
                         .simulated = 25.4,
                         .chance = .4,
                         .misses = false},
          {{"bias_sd", .25}, {"air_drag", .125}}};
}

SurrogateQuality drop_surrogate() {
  return {.observable = "drop",
          .runs = 12,
          .failed_runs = 1,
          .warp = 0,
          .length_scales = {},
          .leave_one_out_sigma = 1.25,
          .leave_one_out_error = .75,
          .inflation = 1.5,
          .coarse = CoarseQuality{.size = 2.5,
                                  .runs = 8,
                                  .failed_runs = 2,
                                  .shift = -.5,
                                  .uncertainty = .25,
                                  .scatter = 1.75}};
}

InputEffect higher_drop() {
  return {.input = "experiment.drop.height_mm",
          .unit = "mm",
          .value = 500,
          .sd = 2,
          .is_assumed = false,
          .readings = {{"drop", .25, .0625}},
          .coefficients = {{"particle_wall.restitution", -.0625, .015625},
                           {"particle_wall.rolling_friction", 0, 0}},
          .not_varied = {"heap"}};
}

/// Rolls whose scatter nobody measured determine the sliding friction.
AssumedScatters assumed_rolls() {
  return {.readings = {{.observable = "roll", .fraction = .35}},
          .coefficients = {{.name = kRestitution,
                            .rests_on = {},
                            .half = {kRestitution, .4, {.35, .45}, Verdict::determined},
                            .twice = {kRestitution, .4, {.35, .45}, Verdict::determined}},
                           {.name = kSliding,
                            .rests_on = {"roll"},
                            .half = {kSliding, .3, {.2, .5}, Verdict::determined},
                            .twice = {kSliding, .3, {.1, .9}, Verdict::undetermined}}}};
}

Prediction held_out_roll() {
  return {.name = "roll",
          .unit = "mm",
          .measured = 300,
          .measured_uncertainty = 5,
          .predicted = 310,
          .uncertainty = 12,
          .interval = {280, 340},
          .coefficients_sd = 11,
          .run_sd = 20,
          .difference_sigma = .75,
          .chance = .47,
          .tolerance = 15,
          .sets = 8,
          .failed_runs = 1,
          .verdict = AgreementVerdict::cannot_tell};
}

SensitivityCheck stiffer_drop() {
  return {.name = "drop",
          .unit = "mm",
          .input = AssumedInput::stiffness,
          .multiple = 10,
          .value = .1,
          .change = -1.5,
          .uncertainty = .5,
          .interval = {-2.75, -.25},
          .chance = .03,
          .limit = 1.25,
          .runs = 5,
          .failed_runs = 1,
          .verdict = AgreementVerdict::cannot_tell};
}

ShapeCheck finer_drop() {
  SensitivityCheck drop = stiffer_drop();
  drop.grain_size = 2.5;
  drop.input = AssumedInput::spheres;
  drop.multiple = 4;
  drop.value = 44;
  drop.verdict = AgreementVerdict::disagrees;
  ShapeCheck shape;
  shape.readings = {drop};
  shape.coefficients = {{"particle_wall.restitution", .44, {.4, .49}, Verdict::determined}};
  shape.over_budget = {"heap"};
  shape.spheres = 11;
  shape.finer_spheres = 44;
  shape.finer_volume_error = .0425;
  return shape;
}

Candidate constant_torque() {
  return {.name = "constant_torque",
          .means = .5,
          .scatter = 4.25,
          .verdict = AgreementVerdict::cannot_tell,
          .values = {{"contact.particle_wall.restitution", .4},
                     {"contact.particle_wall.sliding_friction", .3}}};
}

}  // namespace

StudyResult joint_result() {
  JointResult joint{
      .parameters = {{restitution(), {.1, .9}, Prior{.mean = .5, .sd = .2}},
                     {sliding(), {.1, .8}, {}}},
      .observables = {drop_result()},
      .verdict = AgreementVerdict::cannot_tell,
      .agreement = {.text = "it cannot be told whether bench and simulation agree",
                    .chance = .55,
                    .rounds = 2,
                    .values = {.4, .3}},
      .held_out = {held_out_roll()},
      .stiffness_checks = {stiffer_drop()},
      .stiffer_coefficients =
          {{"particle_wall.restitution", .42, {.39, .46}, Verdict::determined},
           {"particle_wall.rolling_friction", .3, {0, 1}, Verdict::undetermined}},
      .shape_check = finer_drop(),
      .assumed_scatters = assumed_rolls(),
      .assumed_inputs = {higher_drop()},
      .with_assumed = {{"particle_wall.restitution", .4, .1225, .125, {.25, .6}},
                       {"particle_wall.rolling_friction", .5, 0, .5, {0, 1}}},
      .inputs_taken_as_exact = {"experiment.heap.plate_mm"},
      .chi2 = .5,
      .degrees_of_freedom = {},
      .correlation = {{1, .25}, {.25, 1}},
      .reading_correlation = {{1}},
      .bench_correlation = {},
      .equivalence_family = {{{{.41, .5}, 1.5}, AgreementVerdict::disagrees, {26}},
                             {{{.39, .7}, 2.5}, {}, {}}},
      .additions = {{.experiment = "pendulum", .lines = "[experiment.pendulum]\n"}},
      .candidates = {constant_torque()},
      .warnings = {"a <b>bold</b> warning"},
      .surrogates = {drop_surrogate()},
      .rounds = {{.round = 1, .jobs = 12, .seconds = 30, .values = {.45, .4}, .sd = {.1, .2}}},
      .responses = {{.observable = 0,
                     .parameter = 0,
                     .values = {.1, .9},
                     .simulated = {1, 80},
                     .uncertainty = {.1, .2},
                     .scatter = {.5, .5}}},
      .surfaces = {{.observable = 0,
                    .x_parameter = 0,
                    .y_parameter = 1,
                    .x = {.1, .9},
                    .y = {.1, .8},
                    .simulated = {{1, 80}, {2, 81}}}},
      .regressions = {{"drop", surface()}, {"tilt", {}}},
      .runs = {{.job = {.experiment = "drop", .values = {.2, .3}, .seed = 1},
                .readings = {{"value", 7}},
                .failure = ""},
               {.job = {.experiment = "drop", .values = {.9, .3}, .seed = 2},
                .readings = {},
                .failure = "nothing was seen"}}};
  return {.provenance = provenance("joint"), .found = joint};
}

StudyResult published_result() {
  PublishedResult published{
      .values = {{kRestitution, .31}, {kSliding, .25}},
      .sweeps = {{.parameter = kRestitution,
                  .observable = "drop",
                  .measured = 4,
                  .levels = {0, 1, 2, 3},
                  .results = {0, 1, 4, 9},
                  .value = 2,
                  .is_reached = true,
                  .r2 = 1}},
      .steepest_ascent = {{.coefficients = {.1, .1, .01}, .angle_deg = 20, .error_percent = 14},
                          {.coefficients = {.2, .2, .02}, .angle_deg = {}, .error_percent = {}}},
      .composite = {{.coefficients = {.1, .2, .01}, .angle_deg = 22, .error_percent = 6}},
      .error_surface = surface(),
      .least_error_percent = 1.5,
      .verification =
          {.heaps = {{.coefficients = {.1, .2, .02}, .angle_deg = 23, .error_percent = 1.7}},
           .mean_deg = 23,
           .sd_deg = {},
           .measured_deg = 23.4},
      .warnings = {{.code = "ridge", .message = "a ridge"}}};
  return {.provenance = provenance("paper"), .found = published};
}

}  // namespace repose::calibrate::test
