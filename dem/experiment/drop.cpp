#include "dem/experiment/drop.h"

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

namespace repose::dem {

namespace {

constexpr double kLongestTurn = .1;

using Parts = Eigen::Vector4d;  // of a quaternion: x, y, z, w

/// Rate of change of an orientation for a spin about the body's own axes.
Parts rate_of(const Quaternion& orientation, const Vector& own_spin) {
  return .5 * (orientation * Quaternion(0, own_spin.x(), own_spin.y(), own_spin.z())).coeffs();
}

}  // namespace

Grain after_flight(const Grain& grain, const ClumpShape& shape, const Vector& gravity_m_s2,
                   double time_s) {
  Grain after = grain;
  after.position += time_s * grain.velocity + .5 * time_s * time_s * gravity_m_s2;
  after.velocity += time_s * gravity_m_s2;

  // Angular momentum per mass.
  const Vector momentum =
      grain.orientation *
      (grain.orientation.conjugate() * grain.spin).cwiseProduct(shape.gyration_m2);
  const auto own_spin = [&](const Quaternion& orientation) -> Vector {
    return (orientation.conjugate() * momentum).cwiseQuotient(shape.gyration_m2);
  };
  const auto rate = [&](const Parts& parts) {
    const Quaternion orientation = Quaternion(parts).normalized();
    return rate_of(orientation, own_spin(orientation));
  };
  const double fastest = momentum.norm() / shape.gyration_m2.minCoeff();
  const double steps = std::max(1.0, std::ceil(fastest * time_s / kLongestTurn));
  const double step_s = time_s / steps;
  for (int k = 0; k < static_cast<int>(steps); ++k) {
    const Parts q = after.orientation.coeffs();
    const Parts a = rate(q);
    const Parts b = rate(q + .5 * step_s * a);
    const Parts c = rate(q + .5 * step_s * b);
    const Parts d = rate(q + step_s * c);
    after.orientation = Quaternion(Parts(q + step_s / 6 * (a + 2 * b + 2 * c + d))).normalized();
  }
  after.spin = after.orientation * own_spin(after.orientation);
  return after;
}

namespace {

/// Steps between reports; every step is examined, as an impact takes only some 48.
constexpr int kStepsBetweenReports = 16;

void find_errors_of(std::string_view experiment, double height_m, int grains,
                    base::Faults& errors) {
  errors.require(std::isfinite(height_m) && height_m > 0,
                 {.subject = fmt::format("{}.height_m", experiment),
                  .value = fmt::format("is {:g}", height_m),
                  .rule = "above 0",
                  .fix = "the height of the drop test, such as 0.5."});
  errors.require(grains >= 1 && grains <= kMaxGrains,
                 {.subject = fmt::format("{}.grains", experiment),
                  .value = fmt::format("is {}", grains),
                  .rule = fmt::format("1 to {}", kMaxGrains),
                  .fix = "10."});
}

/// The ground and the conditions of a drop.
struct Dropping {
  double height_m = 0;
  int grains = 0;
  std::vector<Wall> ground;
  double top_m = 0;   ///< highest point of the ground
  double tile_m = 0;  ///< random places within this side length; 0: all places are equivalent
};

/// State of one grain's bounce.
struct Bounce {
  double first_touch_m = 0;  ///< height of the centroid
  double lowest_m = 0;       ///< lowest height of the centroid so far
  bool is_rising = false;
  bool is_over = false;
  double rise_m = 0;
  double above_first_touch_m = 0;
  double lowest_point_m = 0;
};

bool touches_nothing(const Simulation& simulation, int number) {
  const Vector weight = simulation.mass_kg(number) * simulation.setup().gravity;
  return (simulation.force_n(number) - weight).norm() <= 1e-9 * weight.norm();
}

/// Computes the top of the flight of a grain that touches nothing until then.
void read_top(Bounce& bounce, const Simulation& simulation, const Grain& grain) {
  const SimulationSetup& setup = simulation.setup();
  const ClumpShape& shape = setup.kinds.front().shape;
  const double flight_s = std::max(0.0, grain.velocity.z()) / kStandardGravity_m_s2;
  const Grain top = after_flight(grain, shape, setup.gravity, flight_s);
  bounce.is_over = true;
  bounce.rise_m = top.position.z() - bounce.lowest_m;
  bounce.above_first_touch_m = top.position.z() - bounce.first_touch_m;
  bounce.lowest_point_m = lowest_m(shape, top);
}

/// The bounce ends when a grain stops rising without contact, at the top of its first flight; that
/// is computed in advance once the grain is too high for any part of it to reach the wall. A grain
/// that stops rising while in contact is toppling, and still bouncing.
void follow(Bounce& bounce, const Simulation& simulation, double top_m, int number) {
  const Grain grain = simulation.grain(number);
  const double height = grain.position.z();
  bounce.lowest_m = std::min(bounce.lowest_m, height);
  const bool was_rising = bounce.is_rising;
  bounce.is_rising = grain.velocity.z() > 0;
  const bool is_out_of_reach =
      bounce.is_rising && height > top_m + simulation.setup().kinds.front().shape.reach_m();
  const bool is_at_top = was_rising && !bounce.is_rising;
  if (!is_out_of_reach && !is_at_top) return;
  if (touches_nothing(simulation, number)) read_top(bounce, simulation, grain);
}

/// Where in their fall grains start: just above the ground, at the speed sqrt(2 g h) of the fall;
/// or at rest at the release height.
struct FallStart {
  double above_m = 0;
  double speed_m_s = 0;
};

/// Adds the grains above the ground, far enough apart not to meet.
std::vector<Bounce> drop_grains(Simulation& simulation, const Dropping& dropping,
                                const FallStart& start, Random& random) {
  const ClumpShape& shape = simulation.setup().kinds.front().shape;
  const double spacing = drop_spacing_m(dropping.height_m, shape.reach_m());
  std::vector<Bounce> bounces;
  for (int k = 0; k < dropping.grains; ++k) {
    Grain grain{.orientation = random.orientation(), .velocity = {0, 0, -start.speed_m_s}};
    const double height =
        dropping.top_m + reach_towards(shape, grain.orientation, -Vector::UnitZ());
    grain.position = {k * spacing, 0, height + start.above_m};
    if (dropping.tile_m > 0) {
      grain.position.x() += random.between(0, dropping.tile_m);
      grain.position.y() += random.between(0, dropping.tile_m);
    }
    simulation.add(grain);
    bounces.push_back({.first_touch_m = height, .lowest_m = height});
  }
  return bounces;
}

double mean_mm(const std::vector<Bounce>& bounces, double Bounce::*reading) {
  double sum = 0;
  for (const Bounce& bounce : bounces) sum += bounce.*reading;
  return 1e3 * sum / static_cast<double>(bounces.size());
}

Readings readings_of(const std::vector<Bounce>& bounces) {
  const double mean = mean_mm(bounces, &Bounce::rise_m);
  double squares = 0;
  double never_rose = 0;
  for (const Bounce& bounce : bounces) {
    squares += std::pow(1e3 * bounce.rise_m - mean, 2);
    never_rose += bounce.is_over ? 0 : 1;
  }
  return {{"above_first_touch_mm", mean_mm(bounces, &Bounce::above_first_touch_m)},
          {"lowest_point_rise_mm", mean_mm(bounces, &Bounce::lowest_point_m)},
          {"sd_mm", scatter_of(squares, bounces.size())},
          {"never_rose", never_rose}};
}

/// The same grains for frames: held at their height at first, until all are at rest or, if they
/// keep bouncing or rolling, for many times the duration of the fall.
void show_drop(const Model& model, const Dropping& dropping, Random random,
               const Observers& observers) {
  constexpr double kMaxFalls = 30;
  const double speed = std::sqrt(2 * kStandardGravity_m_s2 * dropping.height_m);
  ExperimentRun run(Simulation(model_setup(model, model.grain, dropping.ground, speed)), observers);
  drop_grains(run.simulation(), dropping, {.above_m = dropping.height_m}, random);
  RestTest rest(run.simulation().setup());
  const std::int64_t steps = run.steps_of(rest.interval_s());
  const double longest_s = kMaxFalls * speed / kStandardGravity_m_s2;
  while (run.simulation().time_s() < longest_s && !rest.is_at_rest(run.simulation())) {
    run.advance(steps);
    run.report_progress(run.simulation().time_s() / longest_s);
  }
}

/// If frames are recorded, the experiment is run a second time for them.
Repeat dropped(const Model& model, const Dropping& dropping, Random random, std::uint64_t seed,
               const Observers& observers) {
  if (observers.record.frame) show_drop(model, dropping, random, observers);
  const double speed = std::sqrt(2 * kStandardGravity_m_s2 * dropping.height_m);
  const RunRecord unseen;
  ExperimentRun run(Simulation(model_setup(model, model.grain, dropping.ground, speed)),
                    {observers.report, unseen});
  std::vector<Bounce> bounces =
      drop_grains(run.simulation(), dropping, {.speed_m_s = speed}, random);
  // No flight lasts longer than the fall; a grain still on the wall after twice that plus the time
  // to topple lies still.
  const double longest_s = 2 * speed / kStandardGravity_m_s2 +
                           4 * std::sqrt(2 * model.grain.reach_m() / kStandardGravity_m_s2);
  bool are_over = false;
  for (int step = 0; !are_over && run.simulation().time_s() < longest_s; ++step) {
    run.advance(1);
    are_over = true;
    for (int k = 0; k < dropping.grains; ++k) {
      Bounce& bounce = bounces[static_cast<std::size_t>(k)];
      if (!bounce.is_over) follow(bounce, run.simulation(), dropping.top_m, k);
      are_over = are_over && bounce.is_over;
    }
    if (step % kStepsBetweenReports == 0)
      run.report_progress(run.simulation().time_s() / longest_s);
  }
  return run.finish(mean_mm(bounces, &Bounce::rise_m), seed, readings_of(bounces));
}

void find_low_error(const DropProtocol& protocol, base::Faults& errors) {
  if (!protocol.low_height_m) return;
  errors.require(*protocol.low_height_m > 0 && *protocol.low_height_m < protocol.height_m,
                 {.subject = "drop.low_height_m",
                  .value = fmt::format("is {:g}, drop.height_m {:g}", *protocol.low_height_m,
                                       protocol.height_m),
                  .rule = "above 0, and below the other",
                  .fix = "the lower of the two heights, such as 0.05."});
}

/// Adds the results of the lower drop.
void add_low(const Repeat& low, Repeat& repeat) {
  repeat.readings["low_rebound_mm"] = low.value;
  repeat.steps += low.steps;
  repeat.timestep_s = std::min(repeat.timestep_s, low.timestep_s);
  repeat.clump_steps += low.clump_steps;
}

}  // namespace

Repeat run_drop(const Model& model, const DropProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report, const RunRecord& record) {
  base::Faults errors;
  find_errors(model, errors);
  find_errors_of("drop", protocol.height_m, protocol.grains, errors);
  find_low_error(protocol, errors);
  errors.throw_if_any();
  Dropping dropping{
      .height_m = protocol.height_m, .grains = protocol.grains, .ground = {study_wall(Plane{})}};
  Repeat repeat = dropped(model, dropping, Random(seed), seed, {report, record});
  if (!protocol.low_height_m) return repeat;
  dropping.height_m = *protocol.low_height_m;
  const RunRecord unseen;
  add_low(dropped(model, dropping, Random(seed), seed, {report, unseen}), repeat);
  return repeat;
}

Repeat run_drop_on_grains(const Model& model, const GrainDropProtocol& protocol, std::uint64_t seed,
                          const ProgressReport& report, const RunRecord& record) {
  base::Faults errors;
  find_errors(model, errors);
  find_errors_of("drop_on_grains", protocol.height_m, protocol.grains, errors);
  find_coverage_error("drop_on_grains", protocol.coverage, errors);
  errors.throw_if_any();
  Random random(seed);
  const SphereBed bed = glued_bed(model.grain, protocol.coverage, random);
  const Dropping dropping{.height_m = protocol.height_m,
                          .grains = protocol.grains,
                          .ground = grain_covered(study_wall(Plane{}), bed),
                          .top_m = top_m(bed),
                          .tile_m = bed.tile};
  return dropped(model, dropping, random, seed, {report, record});
}

namespace {

std::vector<ProtocolKey> keys_of_drop(Protocol& protocol) {
  auto& drop = protocol.as<DropProtocol>();
  ProtocolKey low = length_key("low_height_mm", "50", drop.low_height_m, "none");
  low.needs = low.name;
  return {length_key("height_mm", "500", drop.height_m),
          count_key("grains", "10", kMaxGrains, drop.grains), low};
}

/// The height of the fall, plus the difference between lying flat below and standing above.
Range possible_drop(const Model& model, const Protocol& protocol) {
  const double height_m = protocol.as<DropProtocol>().height_m;
  return from_to(0, 1e3 * (height_m + 2 * model.grain.reach_m()));
}

/// A rebound is at most the height of the fall plus the grain's rise from lying to standing.
std::optional<ReadingLimit> limit_of_low_rebound(const Model& model, const Protocol& protocol) {
  const auto& low_m = protocol.as<DropProtocol>().low_height_m;
  if (!low_m) return std::nullopt;
  return ReadingLimit{
      .most = 1e3 * (*low_m + 2 * model.grain.reach_m()),
      .reason = fmt::format("low_height_mm = {:.4g} and from lying to standing with this grain",
                            1e3 * *low_m)};
}

double cost_of_drop_s(const Model& /*model*/, const Protocol& protocol) {
  const auto& drop = protocol.as<DropProtocol>();
  return kImpact_s * drop.grains * (drop.low_height_m ? 2 : 1);
}

}  // namespace

ExperimentEntry drop_entry() {
  return {.name = "drop",
          .unit = "mm",
          .value_name = "rebound height",
          .description = "A grain falls on the flat plate.",
          .readings = {{"lowest_point_rise_mm", "mm", true},
                       {.name = "low_rebound_mm",
                        .unit = "mm",
                        .is_measurable = true,
                        .needs = "low_height_mm",
                        .has_own_trials = true,
                        .limit = limit_of_low_rebound},
                       {"above_first_touch_mm", "mm"},
                       {"sd_mm", "mm"},
                       {"never_rose", ""}},
          .coefficients = {kWallRestitution, kWallSliding, kWallRolling},
          .tells = kWallRestitution,
          .sheet = {.test = "restitution",
                    .value = "rebound_mm",
                    .protocol = {{"drop_mm", "height_mm"}}},
          .is_in_air = true,
          .filmed = FilmedMotion::fall,
          .readings_per_run =
              [](const Protocol& protocol) { return protocol.as<DropProtocol>().grains; },
          .softening_effect = "rebounds less than one with the real stiffness",
          .usual_scatter = .2,
          .usual = DropProtocol{},
          .keys = keys_of_drop,
          .run = run_as<DropProtocol, run_drop>,
          .fall_m = [](const ClumpShape& /*grain*/,
                       const Protocol& protocol) { return protocol.as<DropProtocol>().height_m; },
          .possible = possible_drop,
          .cost_s = cost_of_drop_s};
}

namespace {

std::vector<ProtocolKey> keys_of_drop_on_grains(Protocol& protocol) {
  auto& drop = protocol.as<GrainDropProtocol>();
  return {length_key("height_mm", "200", drop.height_m),
          count_key("grains", "20", kMaxGrains, drop.grains), coverage_key(drop.coverage)};
}

/// The height of the fall, plus the rise from a hollow between glued grains to standing above them.
Range possible_rise(const Model& model, const Protocol& protocol) {
  const double height_m = protocol.as<GrainDropProtocol>().height_m;
  return from_to(0, 1e3 * (height_m + 4 * model.grain.reach_m()));
}

/// A grain touches several others repeatedly before it rebounds.
double cost_of_drop_on_grains_s(const Model& model, const Protocol& protocol) {
  constexpr double kSteps = 1e4;
  const int grains = protocol.as<GrainDropProtocol>().grains;
  return grains * (kImpact_s + kSteps * step_on_grains_s(model, 1));
}

}  // namespace

/// For both 6 mm glass beads and hazelnuts, restitution from .2 to .8 changed the rise twentyfold,
/// rolling friction from .02 to .2 by a third, sliding friction by less than its scatter.
ExperimentEntry drop_on_grains_entry() {
  return {
      .name = "drop_on_grains",
      .unit = "mm",
      .value_name = "rebound height from grains",
      .description = "A grain falls on a plate that is covered with glued grains of its kind.",
      .readings = {{"lowest_point_rise_mm", "mm"},
                   {"above_first_touch_mm", "mm"},
                   {"sd_mm", "mm"},
                   {"never_rose", ""}},
      .coefficients = {kGrainRestitution, kGrainSliding, kGrainRolling},
      .tells = kGrainRestitution,
      .sheet = {.test = "drop_on_grains",
                .value = "rebound_mm",
                .protocol = {{"drop_mm", "height_mm"}}},
      .is_default = false,
      .is_in_air = true,
      .readings_per_run =
          [](const Protocol& protocol) { return protocol.as<GrainDropProtocol>().grains; },
      .softening_effect = "rebounds less than one with the real stiffness",
      .usual_scatter = .45,
      .usual_model_error = .03,
      .usual = GrainDropProtocol{},
      .keys = keys_of_drop_on_grains,
      .run = run_as<GrainDropProtocol, run_drop_on_grains>,
      .fall_m = [](const ClumpShape& /*grain*/,
                   const Protocol& protocol) { return protocol.as<GrainDropProtocol>().height_m; },
      .possible = possible_rise,
      .cost_s = cost_of_drop_on_grains_s};
}

}  // namespace repose::dem
