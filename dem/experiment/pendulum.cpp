#include "dem/experiment/pendulum.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/experiment/entry.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_run.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/tilt.h"

namespace repose::dem {

namespace {

/// Distance along x between the centres of two rotated grains that just touch.
double touching_distance_m(const ClumpShape& shape, const Quaternion& a, const Quaternion& b) {
  double distance = 0;
  for (const ClumpSphere& one : shape.spheres) {
    for (const ClumpSphere& other : shape.spheres) {
      const Vector apart = a * one.centre - b * other.centre;
      const double reach = one.radius + other.radius;
      const double chord2 = reach * reach - apart.y() * apart.y() - apart.z() * apart.z();
      if (chord2 > 0) distance = std::max(distance, apart.x() + std::sqrt(chord2));
    }
  }
  return distance;
}

}  // namespace

HangingPair hanging_pair(const ClumpShape& shape, Random& random) {
  HangingPair pair;
  pair.swinging = random.orientation();
  pair.hanging = random.orientation();
  pair.apart_m =
      touching_distance_m(shape, pair.swinging, pair.hanging) + kPendulumGap * shape.reach_m();
  return pair;
}

double release_height_m(const PendulumProtocol& protocol) {
  return protocol.string_m * (1 - std::cos(protocol.release_deg * kDegree));
}

double swing_speed_m_s(const PendulumProtocol& protocol) {
  return std::sqrt(2 * kStandardGravity_m_s2 * release_height_m(protocol));
}

namespace {

constexpr double kLongestString_m = 100;
/// Spacing of pairs, in reaches of a grain.
constexpr double kSpacing = 20;

void check(const Model& model, const PendulumProtocol& protocol) {
  base::Faults errors;
  find_errors(model, errors);
  errors.require(protocol.string_m > model.grain.reach_m() && protocol.string_m <= kLongestString_m,
                 {.subject = "pendulum.string_m",
                  .value = fmt::format("is {:g}", protocol.string_m),
                  .rule = fmt::format("longer than half a grain, {:.4g}, at most {:g}",
                                      model.grain.reach_m(), kLongestString_m),
                  .fix = "the distance from the hinge to the grain's middle, such as 0.3."});
  errors.require(protocol.release_deg > 0 && protocol.release_deg <= 90,
                 {.subject = "pendulum.release_deg",
                  .value = fmt::format("is {:g}", protocol.release_deg),
                  .rule = "above 0, at most 90: higher, strings are slack",
                  .fix = "30."});
  errors.require(protocol.pairs >= 1 && protocol.pairs <= kMaxGrains / 2,
                 {.subject = "pendulum.pairs",
                  .value = fmt::format("is {}", protocol.pairs),
                  .rule = fmt::format("1 to {}", kMaxGrains / 2),
                  .fix = "10."});
  errors.throw_if_any();
}

/// Adds pairs whose strings are vertical at this moment: one grain at rest, one about to touch it.
///
/// An impact takes a fraction of a millisecond, during which the strings only carry the weight:
/// gravity and strings are both omitted.
void hang_pairs(Simulation& simulation, const PendulumProtocol& protocol, double speed_m_s,
                std::uint64_t seed) {
  Random random(seed);
  const ClumpShape& shape = simulation.setup().kinds.front().shape;
  const double reach = shape.reach_m();
  for (int k = 0; k < protocol.pairs; ++k) {
    const double aside = kSpacing * reach * k;
    const HangingPair pair = hanging_pair(shape, random);
    simulation.add({.position = {-pair.apart_m, aside, 0},
                    .orientation = pair.swinging,
                    .velocity = {speed_m_s, 0, 0}});
    simulation.add({.position = {0, aside, 0}, .orientation = pair.hanging});
  }
}

/// Runs until all pairs have collided and separated.
void collide(ExperimentRun& run, double speed_m_s) {
  const double reach_s = run.shape().reach_m() / speed_m_s;
  const std::int64_t steps = run.steps_of(kPendulumLook * reach_s);
  run.advance(run.steps_of(2 * kPendulumGap * reach_s));
  while (!run.simulation().contacts().empty() &&
         run.simulation().time_s() < kPendulumLongest * reach_s) {
    run.advance(steps);
    run.report_progress(run.simulation().time_s() / (kPendulumLongest * reach_s));
  }
}

}  // namespace

Repeat run_pendulum(const Model& model, const PendulumProtocol& protocol, std::uint64_t seed,
                    const ProgressReport& report, const RunRecord& record) {
  check(model, protocol);
  const double speed = swing_speed_m_s(protocol);
  const double height_m = release_height_m(protocol);
  SimulationSetup setup = model_setup(model, model.grain, {}, speed);
  setup.gravity = Vector::Zero();
  ExperimentRun run(Simulation(std::move(setup)), {report, record});
  hang_pairs(run.simulation(), protocol, speed, seed);
  collide(run, speed);
  std::vector<double> swings_deg;
  double rise_m = 0, mean = 0, squares = 0;
  for (int k = 0; k < protocol.pairs; ++k) {
    // The struck grain swings in the plane of the strings; its lateral velocity does not count.
    const double after = std::max(0.0, run.simulation().grain(2 * k + 1).velocity.x());
    const double rise = after * after / (2 * kStandardGravity_m_s2);
    rise_m += rise / protocol.pairs;
    swings_deg.push_back(std::acos(1 - std::min(1.0, rise / protocol.string_m)) / kDegree);
    mean += swings_deg.back() / protocol.pairs;
  }
  for (const double swing : swings_deg) squares += (swing - mean) * (swing - mean);
  return run.finish(mean, seed,
                    {{"rise_mm", 1e3 * rise_m},
                     {"height_ratio", rise_m / height_m},
                     {"sd_deg", scatter_of(squares, swings_deg.size())}});
}

namespace {

std::vector<ProtocolKey> keys_of_pendulum(Protocol& protocol) {
  auto& pendulum = protocol.as<PendulumProtocol>();
  return {length_key("string_mm", "300", pendulum.string_m),
          number_key("release_deg", "30", above(0, 90), pendulum.release_deg),
          count_key("pairs", "10", kMaxGrains / 2, pendulum.pairs)};
}

double cost_of_pendulum_s(const Model& /*model*/, const Protocol& protocol) {
  return kImpact_s * protocol.as<PendulumProtocol>().pairs;
}

}  // namespace

ExperimentEntry pendulum_entry() {
  return {.name = "pendulum",
          .unit = "deg",
          .value_name = "swing of the struck grain",
          .description =
              "Two grains hang on strings, side by side; one is drawn aside, let go, and strikes "
              "the other, which swings up.",
          .readings = {{"rise_mm", "mm"}, {"height_ratio", ""}, {"sd_deg", "deg"}},
          .coefficients = {kGrainRestitution, kGrainSliding, kGrainRolling},
          .tells = kGrainRestitution,
          .sheet = {.test = "pendulum",
                    .value = "swing_deg",
                    .protocol = {{"release_deg", "release_deg"}}},
          .is_default = false,
          .has_plate = false,
          .readings_per_run =
              [](const Protocol& protocol) { return protocol.as<PendulumProtocol>().pairs; },
          .softening_effect = "swings less far than one with the real stiffness",
          .usual = PendulumProtocol{},
          .keys = keys_of_pendulum,
          .run = run_as<PendulumProtocol, run_pendulum>,
          .fall_m =
              [](const ClumpShape& /*grain*/, const Protocol& protocol) {
                return release_height_m(protocol.as<PendulumProtocol>());
              },
          .possible = [](const Model& /*model*/,
                         const Protocol& /*protocol*/) { return from_to(0, 90); },
          .cost_s = cost_of_pendulum_s};
}

}  // namespace repose::dem
