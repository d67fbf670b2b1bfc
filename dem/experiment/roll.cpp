#include "dem/experiment/roll.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/experiment/entry.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_run.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/rest_test.h"

namespace repose::dem {

Incline incline_of(const RollProtocol& protocol) {
  const double angle = protocol.incline_deg * std::numbers::pi / 180;
  Incline slope{.orientation = Quaternion(Eigen::AngleAxisd(angle, Vector::UnitY()))};
  slope.down = slope.orientation * Vector::UnitX();
  slope.normal = slope.orientation * Vector::UnitZ();
  return slope;
}

int most_releases(const ClumpShape& shape) {
  constexpr int kMaxReleases = 10;
  return shape.spheres.size() == 1 ? 1 : kMaxReleases;
}

Grain released(const ClumpShape& shape, const RollProtocol& protocol, Random& random) {
  const Incline slope = incline_of(protocol);
  const double turn = protocol.release_turn_deg * std::numbers::pi / 180;
  const double which_end = random.uniform() < .5 ? 0 : std::numbers::pi;
  const double about_normal = which_end + random.between(-turn, turn);
  const double about_long_axis = 2 * std::numbers::pi * random.uniform();
  Grain grain;
  grain.orientation =
      slope.orientation * Quaternion(Eigen::AngleAxisd(about_normal, Vector::UnitZ())) *
      Quaternion(Eigen::AngleAxisd(about_long_axis, Vector::UnitY())) * lying_pose(shape);
  grain.position = -protocol.release_m * slope.down +
                   reach_towards(shape, grain.orientation, -slope.normal) * slope.normal;
  return grain;
}

namespace {

constexpr double kLongestRun_s = 60;

void check(const Model& model, const RollProtocol& protocol) {
  base::Faults errors;
  find_errors(model, errors);
  errors.require(protocol.incline_deg > 0 && protocol.incline_deg < 90,
                 {.subject = "roll.incline_deg",
                  .value = fmt::format("is {:g}", protocol.incline_deg),
                  .rule = "above 0, below 90",
                  .fix = "the slope of the bench, such as 20."});
  errors.require(std::isfinite(protocol.release_m) && protocol.release_m > 0,
                 {.subject = "roll.release_m",
                  .value = fmt::format("is {:g}", protocol.release_m),
                  .rule = "above 0",
                  .fix = "the distance of the grain from the foot of the incline, such as 0.15."});
  errors.require(
      protocol.release_turn_deg >= 0 && protocol.release_turn_deg <= 90,
      {.subject = "roll.release_turn_deg",
       .value = fmt::format("is {:g}", protocol.release_turn_deg),
       .rule = "0 to 90",
       .fix = "10 for grains that are laid across the slope, 90 for grains that lie anyhow."});
  errors.throw_if_any();
}

/// An infinite flat, and on it a box whose upper face meets it at the foot without a step.
std::vector<Wall> walls_of(const Model& model, const RollProtocol& protocol, const Incline& slope) {
  const double reach_m = model.grain.reach_m();
  const double length = protocol.release_m + 10 * reach_m;
  const double thickness = 4 * reach_m;
  const double width = 20 * (protocol.release_m + reach_m);
  const Vector centre = -.5 * length * slope.down - .5 * thickness * slope.normal;
  return {study_wall(Plane{}), part_wall(model, WallPart::incline,
                                         Box{.half_size = .5 * Vector(length, width, thickness)},
                                         {.position = centre, .orientation = slope.orientation})};
}

/// Describes the motion of a grain that does not stop, and the coefficient that would stop it.
std::string unrest(const Model& model, const Grain& grain) {
  const PairCoefficients& wall = model.grain_wall;
  const double height = grain.position.z();
  const double gap = std::max(0., lowest_m(model.grain, grain));
  const double bounce = .5 * std::pow(grain.velocity.z(), 2) + kStandardGravity_m_s2 * gap;
  const Vector along = grain.velocity - grain.velocity.z() * Vector::UnitZ();
  if (bounce > .5 * along.squaredNorm()) {
    return fmt::format(
        "it bounces by {:.2g} mm. Fix: less restitution between particle and wall, which is {:g}",
        1e3 * bounce / kStandardGravity_m_s2, wall.restitution);
  }
  const Vector slip = along + grain.spin.cross(-height * Vector::UnitZ());
  if (slip.norm() > .5 * along.norm()) {
    return fmt::format(
        "it slides at {:.2g} m/s. Fix: more sliding friction between particle and wall, which is "
        "{:g}",
        along.norm(), wall.sliding_friction);
  }
  const std::string rolls = fmt::format("it rolls at {:.2g} m/s. Fix: ", along.norm());
  if (model.rolling == RollingModel::none) {
    return rolls + "a rolling_model other than none, under which grains never stop rolling";
  }
  return rolls + fmt::format("more rolling friction between particle and wall, which is {:g}",
                             wall.rolling_friction);
}

/// @return how high the grain's lowest point rose above the flat once it was on it, m
double roll_to_rest(ExperimentRun& run, const Model& model) {
  RestTest rest(run.simulation().setup());
  const std::int64_t steps = run.steps_of(rest.interval_s());
  double hop_m = 0;
  while (!rest.is_at_rest(run.simulation())) {
    const Grain grain = run.simulation().grain(0);
    // Closer to the foot it may still touch the incline.
    if (grain.position.x() > model.grain.reach_m()) {
      hop_m = std::max(hop_m, lowest_m(model.grain, grain));
    }
    if (run.simulation().time_s() > kLongestRun_s) {
      throw NoMeasurement(
          fmt::format("roll: the grain still moves after {:g} s, {:.2f} m from the "
                      "foot: {}.",
                      kLongestRun_s, grain.position.x(), unrest(model, grain)));
    }
    run.advance(steps);
    run.report_progress(run.simulation().time_s() / kLongestRun_s);
  }
  return hop_m;
}

/// Distance along the flat, m; 0 if the grain has stayed on the incline.
double on_flat_m(const Simulation& simulation) {
  return std::max(0., simulation.grain(0).position.x());
}

/// One release, until at rest.
struct Rolled {
  ExperimentRun run;
  double hop_m = 0;  ///< see roll_to_rest()
};

Rolled rolled(const Model& model, const RollProtocol& protocol, const Grain& grain,
              const Observers& observers) {
  const Incline slope = incline_of(protocol);
  const double reach = model.grain.reach_m();
  // No part of the grain hits a wall faster than after a free fall from the release point.
  const double speed =
      std::sqrt(2 * kStandardGravity_m_s2 * (reach - protocol.release_m * slope.down.z()));
  ExperimentRun run(Simulation(model_setup(model, model.grain, walls_of(model, protocol, slope),
                                           speed, kBulkFraction)),
                    observers);
  run.simulation().add(grain);
  const double hop_m = roll_to_rest(run, model);
  return {std::move(run), hop_m};
}

}  // namespace

Repeat run_roll(const Model& model, const RollProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report, const RunRecord& record) {
  check(model, protocol);
  const RunRecord unseen;
  Random random(seed);
  for (int releases = 1;; ++releases) {
    const Grain grain = released(model.grain, protocol, random);
    Rolled roll = rolled(model, protocol, grain, {report, unseen});
    const Simulation& simulation = roll.run.simulation();
    const double reached_m = on_flat_m(simulation);
    if (reached_m == 0 && releases < most_releases(model.grain)) continue;
    const Readings readings = {{"lateral_mm", 1e3 * simulation.grain(0).position.y()},
                               {"stopped_on_incline", reached_m == 0 ? 1 : 0},
                               {"releases", releases},
                               {"hop_mm", 1e3 * roll.hop_m},
                               {"time_s", simulation.time_s()}};
    if (!record.frame) return roll.run.finish(1e3 * reached_m, seed, readings);
    // Frames show the release that counts.
    return rolled(model, protocol, grain, {report, record})
        .run.finish(1e3 * reached_m, seed, readings);
  }
}

namespace {

std::vector<ProtocolKey> keys_of_roll(Protocol& protocol) {
  auto& roll = protocol.as<RollProtocol>();
  return {number_key("incline_deg", "20", between(0, 90), roll.incline_deg),
          length_key("release_mm", "150", roll.release_m),
          number_key("release_turn_deg", "10", {.from = 0, .to = 90}, roll.release_turn_deg)};
}

/// No upper limit here; the fit has one, see kMaxReading.
Range possible_roll(const Model& /*model*/, const Protocol& /*protocol*/) { return {.from = 0}; }

double cost_of_roll_s(const Model& model, const Protocol& /*protocol*/) {
  constexpr double kSpeed_m_s = 1, kRun_s = 2;
  return step_on_wall_s(model, 1) * kRun_s / bulk_timestep_s(model, kSpeed_m_s);
}

}  // namespace

ExperimentEntry roll_entry() {
  return {
      .name = "roll",
      .unit = "mm",
      .value_name = "rolling distance",
      .description =
          "A grain is laid across an incline, let go, and rolls on along the flat plate. One that "
          "stays on the incline is let go again, up to ten times, and then counts as 0. The "
          "distance is from the foot of the incline.",
      .readings = {{"lateral_mm", "mm"},
                   {"stopped_on_incline", ""},
                   {"releases", ""},
                   {"hop_mm", "mm"},
                   {"time_s", "s"}},
      .coefficients = {kWallRestitution, kWallSliding, kWallRolling},
      .parts = {WallPart::incline},
      .tells = kWallRolling,
      .sheet = {.test = "rolling",
                .value = "stopped_mm",
                .protocol = {{"incline_deg", "incline_deg"}, {"released_mm", "release_mm"}}},
      .filmed = FilmedMotion::roll,
      .usual_scatter = .35,
      .usual_model_error = .02,
      .usual = RollProtocol{},
      .keys = keys_of_roll,
      .run = run_as<RollProtocol, run_roll>,
      .fall_m =
          [](const ClumpShape& grain, const Protocol& protocol) {
            const auto& roll = protocol.as<RollProtocol>();
            return grain.reach_m() +
                   roll.release_m * std::sin(roll.incline_deg * std::numbers::pi / 180);
          },
      .possible = possible_roll,
      .cost_s = cost_of_roll_s};
}

}  // namespace repose::dem
