#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_run.h"
#include "dem/experiment/incline.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/rest_test.h"

namespace repose::dem {
namespace {

constexpr double kLongestRun_s = 60;
constexpr int kMostReleases = 10;

void check(const Model& model, const RollProtocol& protocol) {
  base::ErrorList errors;
  find_errors(model, errors);
  errors.require(protocol.incline_deg > 0 && protocol.incline_deg < 90,
                 fmt::format("roll.incline_deg is {:g}. Rule: above 0, below 90. Fix: the slope of "
                             "the bench, such as 20.",
                             protocol.incline_deg));
  errors.require(
      std::isfinite(protocol.release_m) && protocol.release_m > 0,
      fmt::format("roll.release_m is {:g}. Rule: above 0. Fix: the distance of the grain "
                  "from the foot of the incline, such as 0.15.",
                  protocol.release_m));
  errors.require(
      protocol.release_turn_deg >= 0 && protocol.release_turn_deg <= 90,
      fmt::format("roll.release_turn_deg is {:g}. Rule: 0 to 90. Fix: 10 for grains that are laid "
                  "across the slope, 90 for grains that lie anyhow.",
                  protocol.release_turn_deg));
  errors.throw_if_any();
}

/// A flat without end, and on it a box whose upper face meets it at the foot, without a step.
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

void roll_to_rest(ExperimentRun& run) {
  RestTest rest(run.simulation().setup());
  const std::int64_t steps = run.steps_of(rest.interval_s());
  while (!rest.is_at_rest(run.simulation())) {
    if (run.simulation().time_s() > kLongestRun_s) {
      throw NoReading(fmt::format(
          "roll: the grain still moves after {:g} s, {:.2f} m from the foot. Fix: a rolling "
          "friction above 0; grains of several spheres may do without.",
          kLongestRun_s, run.simulation().grain(0).position.x()));
    }
    run.advance(steps);
    run.report_progress(run.simulation().time_s() / kLongestRun_s);
  }
}

double along_m(const Simulation& simulation, const Incline& slope) {
  const Vector end = simulation.grain(0).position;
  return end.x() < 0 ? end.dot(slope.down) : end.x();
}

/// One release, from letting go to rest.
ExperimentRun rolled(const Model& model, const RollProtocol& protocol, const Grain& grain,
                     const Observers& observers) {
  const Incline slope = incline_of(protocol);
  const double reach = model.grain.reach_m();
  // No part of the grain meets a wall faster than by a free fall from where it is let go.
  const double speed =
      std::sqrt(2 * kStandardGravity_m_s2 * (reach - protocol.release_m * slope.down.z()));
  ExperimentRun run(Simulation(model_setup(model, model.grain, walls_of(model, protocol, slope),
                                           speed, kBulkFraction)),
                    observers);
  run.simulation().add(grain);
  roll_to_rest(run);
  return run;
}

}  // namespace

Repeat run_roll(const Model& model, const RollProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report, const RunRecord& record) {
  check(model, protocol);
  const Incline slope = incline_of(protocol);
  // A ball lies alike however it is put down.
  const int most_releases = model.grain.spheres.size() == 1 ? 1 : kMostReleases;
  const RunRecord unseen;
  Random random(seed);
  for (int releases = 1;; ++releases) {
    const Grain grain = released(model.grain, protocol, random);
    ExperimentRun run = rolled(model, protocol, grain, {report, unseen});
    const double reached_m = along_m(run.simulation(), slope);
    if (reached_m < 0 && releases < most_releases) continue;
    const std::map<std::string, double> readings = {
        {"lateral_mm", 1e3 * run.simulation().grain(0).position.y()},
        {"stopped_on_incline", reached_m < 0 ? 1 : 0},
        {"releases", releases},
        {"time_s", run.simulation().time_s()}};
    if (!record.frame) return run.finish(1e3 * reached_m, seed, readings);
    // Frames show the release that counts.
    return rolled(model, protocol, grain, {report, record}).finish(1e3 * reached_m, seed, readings);
  }
}

}  // namespace repose::dem
