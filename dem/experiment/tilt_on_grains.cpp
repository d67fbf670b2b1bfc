#include "dem/experiment/tilt_on_grains.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/experiment/entry.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_run.h"
#include "dem/experiment/glued_bed.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/rest_test.h"
#include "dem/experiment/tilt.h"

namespace repose::dem {
namespace {

constexpr int kBoard = 0;
constexpr int kBed = 1;
constexpr int kMaxBonded = 10;
constexpr double kLongestBedSettling_s = 5;
/// Shifts down the slope, in grain diameters, at which a body has first moved, and has left for
/// good.
constexpr double kShift = .1;
constexpr double kSetOff = 1;
/// Below this speed, as a fraction of sqrt(g d), a body stands still.
constexpr double kStill = .01;

/// Common to both experiments: tilting of bonded bodies, rolling of single grains.
struct Tilting {
  std::string_view name;
  int bonded = 1;
  double rate_deg_s = 0;
  int places = 1;
  double coverage = 0;
};

void check(const Model& model, const Tilting& tilting) {
  base::Faults errors;
  find_errors(model, errors);
  find_coverage_error(tilting.name, tilting.coverage, errors);
  errors.require(tilting.bonded >= 1 && tilting.bonded <= kMaxBonded,
                 {.subject = fmt::format("{}.bonded", tilting.name),
                  .value = fmt::format("is {}", tilting.bonded),
                  .rule = fmt::format("1 to {}", kMaxBonded),
                  .fix = "3."});
  errors.require(tilting.places >= 1 && tilting.places <= kMaxGrains,
                 {.subject = fmt::format("{}.places", tilting.name),
                  .value = fmt::format("is {}", tilting.places),
                  .rule = fmt::format("1 to {}", kMaxGrains),
                  .fix = "10."});
  errors.require(tilting.rate_deg_s > 0 && tilting.rate_deg_s <= kFastest_deg_s,
                 {.subject = fmt::format("{}.rate_deg_s", tilting.name),
                  .value = fmt::format("is {:g}", tilting.rate_deg_s),
                  .rule = fmt::format(
                      "above 0, at most {:g}: faster, the plate's own motion throws the grains",
                      kFastest_deg_s),
                  .fix = "the rate of the bench, such as 5."});
  errors.throw_if_any();
}

/// State of one body leaving its place.
struct Leaving {
  double begin_m = 0;    ///< initial position down the slope
  double shift_m = 0;    ///< from there
  double still_deg = 0;  ///< the plate's angle when it last stood still
  std::optional<double> first_shift_deg;
  bool is_over = false;
};

class TiltRun {
 public:
  TiltRun(const Model& model, const Tilting& tilting, std::uint64_t seed,
          const Observers& observers)
      : tilting_(tilting),
        between_(model.grain_grain),
        diameter_m_(diameter_m(model.grain)),
        run_(put_down(model, tilting, seed, observers)),
        bodies_(static_cast<std::size_t>(tilting.places)) {}

  Repeat result(std::uint64_t seed) {
    settle();
    tilt();
    double mean = 0, first = 0, squares = 0;
    const auto count = static_cast<double>(bodies_.size());
    for (const Leaving& body : bodies_) {
      mean += body.still_deg / count;
      first += body.first_shift_deg.value() / count;
    }
    for (const Leaving& body : bodies_) squares += std::pow(body.still_deg - mean, 2);
    return run_.finish(
        mean, seed, {{"first_shift_deg", first}, {"sd_deg", scatter_of(squares, bodies_.size())}});
  }

 private:
  /// Each body over a random place of the bed, in a lane of its own.
  static ExperimentRun put_down(const Model& model, const Tilting& tilting, std::uint64_t seed,
                                const Observers& observers) {
    Random random(seed);
    const ClumpShape body = bonded_shape(model.grain, tilting.bonded);
    const SphereBed bed = glued_bed(model.grain, tilting.coverage, random);
    // Speed of rolling out of one hollow into the next.
    const double speed = std::sqrt(2 * kStandardGravity_m_s2 * diameter_m(model.grain));
    ExperimentRun run(Simulation(model_setup(model, body, grain_covered(study_wall(Plane{}), bed),
                                             speed, kCourseFraction)),
                      observers);
    const Quaternion lying = lying_pose(model.grain);
    const double height = top_m(bed) + reach_towards(body, lying, -Vector::UnitZ());
    for (int k = 0; k < tilting.places; ++k) {
      const double down = random.between(0, bed.tile);
      const double across = random.between(0, bed.tile) + lane_m(body.reach_m()) * k;
      run.simulation().add({.position = {down, across, height}, .orientation = lying});
    }
    return run;
  }

  /// Waits until all bodies have fallen into the bed's hollows and lie still on the level plate.
  void settle() {
    RestTest rest(run_.simulation().setup());
    const std::int64_t steps = run_.steps_of(rest.interval_s());
    while (!rest.is_at_rest(run_.simulation())) {
      if (run_.simulation().time_s() > kLongestBedSettling_s) {
        throw NoMeasurement(fmt::format(
            "{}: the grains do not come to rest on the level plate in {:g} s. Fix: more rolling "
            "friction between particles, which is {:g}, or less restitution, which is {:g}.",
            tilting_.name, kLongestBedSettling_s, between_.rolling_friction, between_.restitution));
      }
      run_.advance(steps);
    }
  }

  /// Turns the plate until all bodies have left their places for good.
  void tilt() {
    Simulation& simulation = run_.simulation();
    const double begin_s = simulation.time_s();
    for (int k = 0; k < tilting_.places; ++k) at(k).begin_m = on_plate(simulation, kBoard, k).x();
    for (const int wall : {kBoard, kBed}) {
      simulation.set_motions(
          wall, {{.spin = tilting_.rate_deg_s * kDegree * Vector::UnitY(), .start_s = begin_s}});
    }
    // A body starting from rest on a slope moves a tenth of its diameter in about ten looks.
    const std::int64_t steps = run_.steps_of(.01 * std::sqrt(diameter_m_ / kStandardGravity_m_s2));
    for (bool are_over = false; !are_over;) {
      run_.advance(steps);
      const double angle = tilting_.rate_deg_s * (simulation.time_s() - begin_s);
      are_over = true;
      for (int k = 0; k < tilting_.places; ++k) are_over = look_at(k, angle, steps) && are_over;
      if (angle > kSteepest_deg && !are_over) {
        throw NoMeasurement(
            fmt::format("{}: grains hold on up to {:g} degrees. Fix: fewer bonded "
                        "grains, or less friction.",
                        tilting_.name, kSteepest_deg));
      }
      run_.report_progress(angle / kSteepest_deg);
    }
  }

  /// @return whether the body has left; it is then removed, except the last one, which is kept for
  /// viewing
  bool look_at(int number, double angle_deg, std::int64_t steps) {
    Leaving& body = at(number);
    if (body.is_over) return true;
    const Simulation& simulation = run_.simulation();
    const double look_s = static_cast<double>(steps) * simulation.setup().timestep_s;
    const double still_m = kStill * std::sqrt(kStandardGravity_m_s2 * diameter_m_) * look_s;
    const double shift = on_plate(simulation, kBoard, number).x() - body.begin_m;
    if (shift - body.shift_m < still_m) body.still_deg = angle_deg;
    body.shift_m = shift;
    if (shift > kShift * diameter_m_ && !body.first_shift_deg) body.first_shift_deg = angle_deg;
    body.is_over = shift > kSetOff * diameter_m_;
    if (body.is_over && --left_ > 0) run_.simulation().remove(number);
    return body.is_over;
  }

  Leaving& at(int body) { return bodies_[static_cast<std::size_t>(body)]; }

  Tilting tilting_;
  PairCoefficients between_;
  double diameter_m_;
  ExperimentRun run_;
  std::vector<Leaving> bodies_;
  int left_ = tilting_.places;
};

}  // namespace

Repeat run_tilt_on_grains(const Model& model, const GrainTiltProtocol& protocol, std::uint64_t seed,
                          const ProgressReport& report, const RunRecord& record) {
  const Tilting tilting{.name = "tilt_on_grains",
                        .bonded = protocol.bonded,
                        .rate_deg_s = protocol.rate_deg_s,
                        .places = protocol.places,
                        .coverage = protocol.coverage};
  check(model, tilting);
  return TiltRun(model, tilting, seed, {report, record}).result(seed);
}

Repeat run_roll_on_grains(const Model& model, const GrainRollProtocol& protocol, std::uint64_t seed,
                          const ProgressReport& report, const RunRecord& record) {
  const Tilting tilting{.name = "roll_on_grains",
                        .rate_deg_s = protocol.rate_deg_s,
                        .places = protocol.places,
                        .coverage = protocol.coverage};
  check(model, tilting);
  return TiltRun(model, tilting, seed, {report, record}).result(seed);
}

namespace {

constexpr const char* kNoConstant =
    "No material constant: glued grains interlock. Calibrate a study with these readings.";

std::vector<ProtocolKey> keys_of_tilt_on_grains(Protocol& protocol) {
  auto& tilt = protocol.as<GrainTiltProtocol>();
  return {count_key("bonded", "3", kMaxBonded, tilt.bonded),
          number_key("rate_deg_s", "5", above(0, 10), tilt.rate_deg_s),
          count_key("places", "10", kMaxGrains, tilt.places), coverage_key(tilt.coverage)};
}

std::vector<ProtocolKey> keys_of_roll_on_grains(Protocol& protocol) {
  auto& roll = protocol.as<GrainRollProtocol>();
  return {number_key("rate_deg_s", "5", above(0, 10), roll.rate_deg_s),
          count_key("places", "10", kMaxGrains, roll.places), coverage_key(roll.coverage)};
}

Range possible_on_grains(const Model& /*model*/, const Protocol& /*protocol*/) {
  return from_to(0, 90);
}

/// Grains roll out of one hollow into the next.
double fall_on_grains_m(const ClumpShape& grain, const Protocol& /*protocol*/) {
  return diameter_m(grain);
}

/// For bodies that lie still until the plate is at about 45 degrees.
double cost_on_grains_s(const Model& model, double rate_deg_s, int bonded, int places) {
  constexpr double kSpeed_m_s = .3, kSettling_s = 1, kLeaves_deg = 45;
  return step_on_grains_s(model, bonded) * places * (kSettling_s + kLeaves_deg / rate_deg_s) /
         rolling_timestep_s(model, kSpeed_m_s);
}

}  // namespace

/// Sliding friction from .2 to .6 changed the angle by about 18 degrees, rolling friction from .02
/// to .2 by 0 to 3, restitution by less than the scatter.
ExperimentEntry tilt_on_grains_entry() {
  return {.name = "tilt_on_grains",
          .unit = "deg",
          .value_name = "angle of sliding on grains",
          .description =
              "Three or more grains, glued side by side so that none can roll, lie on a plate that "
              "is covered with glued grains of their kind, while it is tilted slowly, until they "
              "slide by a grain's diameter.",
          .readings = {{"first_shift_deg", "deg"}, {"sd_deg", "deg"}},
          .coefficients = {kGrainSliding, kGrainRolling},
          .tells = kGrainSliding,
          .sheet = {.test = "tilt_on_grains",
                    .value = "angle_deg",
                    .mean = MeanOfReadings{.what = "tilt at which bonded grains slide off",
                                           .readable = between(0, 90),
                                           .quantity = "angle_of_sliding",
                                           .validity = kNoConstant}},
          .is_default = false,
          .readings_per_run =
              [](const Protocol& protocol) { return protocol.as<GrainTiltProtocol>().places; },
          .usual_scatter = .2,
          .usual_model_error = .03,
          .usual = GrainTiltProtocol{},
          .keys = keys_of_tilt_on_grains,
          .run = run_as<GrainTiltProtocol, run_tilt_on_grains>,
          .body =
              [](const ClumpShape& grain, const Protocol& protocol) {
                return bonded_shape(grain, protocol.as<GrainTiltProtocol>().bonded);
              },
          .fall_m = fall_on_grains_m,
          .possible = possible_on_grains,
          .cost_s =
              [](const Model& model, const Protocol& protocol) {
                const auto& tilt = protocol.as<GrainTiltProtocol>();
                return cost_on_grains_s(model, tilt.rate_deg_s, tilt.bonded, tilt.places);
              }};
}

/// Rolling friction from .02 to .2 changed the angle by about 12 degrees, sliding friction and
/// restitution by less than the scatter.
ExperimentEntry roll_on_grains_entry() {
  return {.name = "roll_on_grains",
          .unit = "deg",
          .value_name = "angle of rolling on grains",
          .description =
              "A single grain lies on a plate that is covered with glued grains of its kind, while "
              "it is tilted slowly, until the grain rolls by its diameter.",
          .readings = {{"first_shift_deg", "deg"}, {"sd_deg", "deg"}},
          .coefficients = {kGrainSliding, kGrainRolling},
          .tells = kGrainRolling,
          .sheet = {.test = "roll_on_grains",
                    .value = "angle_deg",
                    .mean = MeanOfReadings{.what = "tilt at which a single grain rolls off",
                                           .readable = between(0, 90),
                                           .quantity = "angle_of_rolling",
                                           .validity = kNoConstant}},
          .is_default = false,
          .readings_per_run =
              [](const Protocol& protocol) { return protocol.as<GrainRollProtocol>().places; },
          .usual_scatter = .25,
          .usual_model_error = .03,
          .usual = GrainRollProtocol{},
          .keys = keys_of_roll_on_grains,
          .run = run_as<GrainRollProtocol, run_roll_on_grains>,
          .fall_m = fall_on_grains_m,
          .possible = possible_on_grains,
          .cost_s =
              [](const Model& model, const Protocol& protocol) {
                const auto& roll = protocol.as<GrainRollProtocol>();
                return cost_on_grains_s(model, roll.rate_deg_s, 1, roll.places);
              }};
}

}  // namespace repose::dem
