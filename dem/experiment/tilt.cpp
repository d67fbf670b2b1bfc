#include "dem/experiment/tilt.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/experiment/entry.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_run.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/rest_test.h"

namespace repose::dem {

Quaternion slope(double angle_deg) {
  return Quaternion(Eigen::AngleAxisd(angle_deg * kDegree, Vector::UnitY()));
}

Vector on_plate(const Simulation& simulation, int wall, int grain) {
  return simulation.wall(wall).pose.orientation.conjugate() * simulation.grain(grain).position;
}

Quaternion turn_on_plate(const Simulation& simulation, int wall, int grain) {
  return simulation.wall(wall).pose.orientation.conjugate() * simulation.grain(grain).orientation;
}

namespace {

/// Distance along `direction` (unit) between two equal grains that just touch.
double touching_distance_m(const ClumpShape& grain, const Vector& direction) {
  double distance = 0;
  for (const ClumpSphere& a : grain.spheres) {
    for (const ClumpSphere& b : grain.spheres) {
      const Vector apart = a.centre - b.centre;
      const double along = direction.dot(apart);
      const double aside2 = apart.squaredNorm() - along * along;
      const double reach = a.radius + b.radius;
      const double chord2 = reach * reach - aside2;
      if (chord2 > 0) distance = std::max(distance, along + std::sqrt(chord2));
    }
  }
  return distance;
}

}  // namespace

ClumpShape bonded_shape(const ClumpShape& grain, int count) {
  const Vector row = lying_pose(grain).conjugate() * Vector::UnitX();
  const double distance = touching_distance_m(grain, row);
  ClumpShape body;
  body.volume_m3 = count * grain.volume_m3;
  double mean_square = 0;
  for (int k = 0; k < count; ++k) {
    const double place = (k - .5 * (count - 1)) * distance;
    mean_square += place * place / count;
    for (const ClumpSphere& sphere : grain.spheres) {
      body.spheres.push_back({.centre = sphere.centre + place * row, .radius = sphere.radius});
    }
  }
  body.gyration_m2 = grain.gyration_m2 + mean_square * (Vector::Ones() - row.cwiseAbs2());
  return body;
}

namespace {

constexpr int kPlate = 0;
/// Time before sliding or tipping at which the plate starts to turn, and the minimum angle in
/// between.
constexpr double kLead_s = .375;
constexpr double kMinLead_deg = .5;
/// Range of slip used for the onset, as fractions of the grain's reach: from well above the
/// springs' stretch to where the plate has turned by about a degree.
constexpr double kMinSlip = .002;
constexpr double kMaxSlip = .1;
constexpr double kReportedSlip_m = .5e-3;
/// A body that has rotated by this much relative to the plate tips or rolls.
constexpr double kTipped_deg = 5;
constexpr double kLongestGrainSettling_s = 2;
/// Maximum restitution between body and plate. While a body slides, friction and weakly damped
/// contacts excite each other: it rattles, and slides below the angle of friction. It slides
/// slightly even when put down on a slope, until its full weight acts, and would keep rattling. The
/// value measured, the angle at which it starts from rest, does not depend on restitution
/// (Tilt.RestitutionDoesNotMatter).
constexpr double kMaxRestitution = .5;
/// Maximum relative deviation of the slope of the cube root of slip from that for a start from
/// rest. Bodies that start from rest stay within a hundredth.
constexpr double kMaxCreep = .2;

void check(const Model& model, const TiltProtocol& protocol) {
  base::Faults errors;
  find_errors(model, errors);
  errors.require(protocol.bonded >= 1, {.subject = "tilt.bonded",
                                        .value = fmt::format("is {}", protocol.bonded),
                                        .rule = "1 or more",
                                        .fix = "2."});
  errors.require(protocol.rate_deg_s > 0 && protocol.rate_deg_s <= kFastest_deg_s,
                 {.subject = "tilt.rate_deg_s",
                  .value = fmt::format("is {:g}", protocol.rate_deg_s),
                  .rule = fmt::format(
                      "above 0, at most {:g}: faster, the plate's own motion throws the grains",
                      kFastest_deg_s),
                  .fix = "the rate of the bench, such as 2."});
  errors.require(protocol.start_deg >= 0 && protocol.start_deg < kSteepest_deg,
                 {.subject = "tilt.start_deg",
                  .value = fmt::format("is {:g}", protocol.start_deg),
                  .rule = fmt::format("0 or more, below {:g}", kSteepest_deg),
                  .fix = "0."});
  errors.throw_if_any();
}

}  // namespace

Model quiet(Model model) {
  model.grain_wall.restitution = std::min(model.grain_wall.restitution, kMaxRestitution);
  model.grain_wall.restitution_exponent = 0;  // slow contacts would exceed that
  return model;
}

double tipping_deg(const ClumpShape& body, const Quaternion& pose) {
  const double height = reach_towards(body, pose, -Vector::UnitZ());
  double foot = 0;
  for (const ClumpSphere& sphere : body.spheres) {
    const Vector centre = pose * sphere.centre;
    const bool is_low = centre.z() - sphere.radius < -height + .01 * body.reach_m();
    if (is_low) foot = std::max(foot, centre.x());
  }
  return std::atan2(foot, height) / kDegree;
}

double most_slip_m(const ClumpShape& grain) {
  return std::max(kMaxSlip * grain.reach_m(), kReportedSlip_m);
}

void Slide::add(double at_deg, double slipped_m, const ClumpShape& grain) {
  if (slipped_m > kMinSlip * grain.reach_m() && slipped_m <= kMaxSlip * grain.reach_m()) {
    angle_deg.push_back(at_deg);
    slip_m.push_back(slipped_m);
  }
  if (slipped_m > kReportedSlip_m && !reported_deg) reported_deg = at_deg;
}

double onset_deg(const Slide& slide, double begin_deg, double rate_deg_s) {
  const auto count = static_cast<double>(slide.slip_m.size());
  double mean_angle = 0;
  double mean_root = 0;
  for (std::size_t k = 0; k < slide.slip_m.size(); ++k) {
    mean_angle += slide.angle_deg[k] / count;
    mean_root += std::cbrt(slide.slip_m[k]) / count;
  }
  double square = 0;
  double product = 0;
  for (std::size_t k = 0; k < slide.slip_m.size(); ++k) {
    const double off = slide.angle_deg[k] - mean_angle;
    square += off * off;
    product += off * (std::cbrt(slide.slip_m[k]) - mean_root);
  }
  const double onset = mean_angle - mean_root * square / product;
  const double rate = rate_deg_s * kDegree;
  const double from_rest =
      kDegree * std::cbrt(kStandardGravity_m_s2 / (6 * rate * rate * std::cos(onset * kDegree)));
  if (onset >= begin_deg && std::abs(product / square / from_rest - 1) < kMaxCreep) return onset;
  throw NoMeasurement(
      fmt::format("tilt: the body does not set off from rest: it creeps from {:.2f} degrees on, "
                  "where the plate begins to turn. Fix: start_deg = 0, and a lower rate_deg_s.",
                  begin_deg));
}

namespace {

/// Waits until the body is at rest on the plate at its first angle.
void settle_grain(ExperimentRun& run, double begin_deg) {
  RestTest rest(run.simulation().setup());
  const std::int64_t steps = run.steps_of(rest.interval_s());
  while (!rest.is_at_rest(run.simulation())) {
    if (run.simulation().time_s() > kLongestGrainSettling_s) {
      throw NoMeasurement(fmt::format(
          "tilt: the body still moves on the plate at {:.2f} degrees, where that begins to turn, "
          "after {:g} s: it rolls, or that is too near to where it slides. Fix: start_deg = 0, and "
          "bond 2 grains or more.",
          begin_deg, kLongestGrainSettling_s));
    }
    run.advance(steps);
  }
}

/// Time between two looks: about a hundred for the slip used for the onset, by the law in
/// onset_deg() for a level plate.
double look_interval_s(const ClumpShape& grain, double rate_deg_s) {
  const double jerk_m_s3 = kStandardGravity_m_s2 * rate_deg_s * kDegree;
  return .01 * std::cbrt(6 * kMaxSlip * grain.reach_m() / jerk_m_s3);
}

/// Turns the plate until the body has slipped far enough.
Slide slide_off(ExperimentRun& run, const ClumpShape& grain, double begin_deg, double rate_deg_s) {
  Simulation& simulation = run.simulation();
  const double begin_s = simulation.time_s();
  const double before_m = on_plate(simulation, kPlate, 0).x();
  const Quaternion lay = turn_on_plate(simulation, kPlate, 0);
  simulation.set_motions(kPlate,
                         {{.spin = rate_deg_s * kDegree * Vector::UnitY(), .start_s = begin_s}});
  const std::int64_t steps = run.steps_of(look_interval_s(grain, rate_deg_s));
  Slide slide;
  for (double slip = 0; slip <= most_slip_m(grain);) {
    run.advance(steps);
    const double angle = begin_deg + rate_deg_s * (simulation.time_s() - begin_s);
    slip = on_plate(simulation, kPlate, 0).x() - before_m;
    slide.add(angle, slip, grain);
    if (turn_on_plate(simulation, kPlate, 0).angularDistance(lay) > kTipped_deg * kDegree) {
      throw NoMeasurement(
          fmt::format("tilt: the body tipped or rolled at {:.2f} degrees instead of "
                      "sliding. Fix: bond more grains, or lower the sliding friction.",
                      angle));
    }
    if (angle > kSteepest_deg) {
      throw NoMeasurement(
          fmt::format("tilt: the body did not slide up to {:g} degrees", kSteepest_deg));
    }
    run.report_progress(angle / kSteepest_deg);
  }
  return slide;
}

/// For frames: the plate turns from its first angle about a hinge below the body, until the body
/// has slid by some grain widths or tips.
void show_tilt(const Model& model, const TiltProtocol& protocol, const ClumpShape& body,
               const SimulationSetup& setup, const Observers& observers) {
  constexpr double kArm = 20, kShownSlip = 10;  // in reaches of a grain
  SimulationSetup bench = setup;
  bench.walls[kPlate] = study_wall(Plane{}, {.orientation = slope(protocol.start_deg)});
  ExperimentRun run(Simulation(bench), observers);
  const Quaternion lying = lying_pose(model.grain);
  const Quaternion orientation = slope(protocol.start_deg) * lying;
  const Vector place(-kArm * model.grain.reach_m(), 0,
                     reach_towards(body, lying, -Vector::UnitZ()));
  run.simulation().add({.position = slope(protocol.start_deg) * place, .orientation = orientation});
  settle_grain(run, protocol.start_deg);
  const double begin_s = run.simulation().time_s();
  const Quaternion lay = turn_on_plate(run.simulation(), kPlate, 0);
  run.simulation().set_motions(
      kPlate, {{.spin = protocol.rate_deg_s * kDegree * Vector::UnitY(), .start_s = begin_s}});
  const std::int64_t steps = run.steps_of(look_interval_s(model.grain, protocol.rate_deg_s));
  const double before_m = on_plate(run.simulation(), kPlate, 0).x();
  const double most_m = kShownSlip * model.grain.reach_m();
  double angle_deg = protocol.start_deg;
  while (on_plate(run.simulation(), kPlate, 0).x() - before_m < most_m &&
         turn_on_plate(run.simulation(), kPlate, 0).angularDistance(lay) < kTipped_deg * kDegree &&
         angle_deg < kSteepest_deg) {
    run.advance(steps);
    angle_deg = protocol.start_deg + protocol.rate_deg_s * (run.simulation().time_s() - begin_s);
    run.report_progress(angle_deg / kSteepest_deg);
  }
}

}  // namespace

Repeat run_tilt(const Model& model, const TiltProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report, const RunRecord& record) {
  check(model, protocol);
  const ClumpShape body = bonded_shape(model.grain, protocol.bonded);
  const Quaternion lying = lying_pose(model.grain);
  const double hold_deg =
      std::min(std::atan(model.grain_wall.sliding_friction) / kDegree, tipping_deg(body, lying));
  const double lead_deg = std::max(kMinLead_deg, kLead_s * protocol.rate_deg_s);
  const double begin_deg = std::max(protocol.start_deg, hold_deg - lead_deg);
  if (protocol.start_deg > 0 && protocol.start_deg >= hold_deg) {
    throw NoMeasurement(fmt::format(
        "tilt: the plate begins to turn at start_deg = {:g}, where the body slides or tips at "
        "once: it holds up to {:.2f} degrees. Fix: start_deg = 0.",
        protocol.start_deg, hold_deg));
  }
  // The body hits the plate no faster than after a fall through a hundredth of its reach.
  const double speed = std::sqrt(2 * kStandardGravity_m_s2 * .01 * body.reach_m());
  const Wall plate = study_wall(Plane{}, {.orientation = slope(begin_deg)});
  const SimulationSetup setup = model_setup(quiet(model), body, {plate}, speed, kCourseFraction);
  // If frames are recorded, the experiment is run a second time for them.
  if (record.frame) show_tilt(model, protocol, body, setup, {report, record});
  const RunRecord unseen;
  ExperimentRun run(Simulation(setup), {report, unseen});
  const Vector normal = slope(begin_deg) * Vector::UnitZ();
  const Quaternion orientation = slope(begin_deg) * lying;
  run.simulation().add(
      {.position = normal * reach_towards(body, orientation, -normal), .orientation = orientation});
  settle_grain(run, begin_deg);
  const Slide slide = slide_off(run, model.grain, begin_deg, protocol.rate_deg_s);
  return run.finish(onset_deg(slide, begin_deg, protocol.rate_deg_s), seed,
                    {{"half_mm_slip_deg", slide.reported_deg}, {"begin_deg", begin_deg}});
}

namespace {

std::vector<ProtocolKey> keys_of_tilt(Protocol& protocol) {
  constexpr int kMaxBonded = 100;
  auto& tilt = protocol.as<TiltProtocol>();
  return {count_key("bonded", "2", kMaxBonded, tilt.bonded),
          number_key("rate_deg_s", "2", above(0, 10), tilt.rate_deg_s),
          number_key("start_deg", "0", from_to_below(0, kSteepest_deg), tilt.start_deg)};
}

double cost_of_tilt_s(const Model& model, const Protocol& protocol) {
  constexpr double kSpeed_m_s = 1, kRun_s = .7;
  const int bonded = protocol.as<TiltProtocol>().bonded;
  return step_on_wall_s(model, bonded) * kRun_s / rolling_timestep_s(model, kSpeed_m_s);
}

}  // namespace

/// Depends on sliding friction only: rolling friction from .04 to .3 changed the angle by .03
/// degrees, restitution by less than .001.
ExperimentEntry tilt_entry() {
  return {.name = "tilt",
          .unit = "deg",
          .value_name = "angle of sliding",
          .description =
              "Two or more grains, glued side by side so that none can roll, lie on the plate "
              "while it is tilted slowly, until they slide.",
          .readings = {{"half_mm_slip_deg", "deg"}, {"begin_deg", "deg"}},
          .coefficients = {kWallSliding},
          .tells = kWallSliding,
          .sheet = {.test = "sliding", .value = "angle_deg"},
          .is_stochastic = false,
          .filmed = FilmedMotion::slide,
          // A hand or a worn motor does not hold it, and the angle hardly depends on it.
          .filmed_settings = {{"rate_deg_s", "rate_deg_s", .2}},
          .usual_scatter = .1,
          .usual = TiltProtocol{},
          .keys = keys_of_tilt,
          .run = run_as<TiltProtocol, run_tilt>,
          .body =
              [](const ClumpShape& grain, const Protocol& protocol) {
                return bonded_shape(grain, protocol.as<TiltProtocol>().bonded);
              },
          .fall_m = [](const ClumpShape& grain,
                       const Protocol& /*protocol*/) { return .01 * grain.reach_m(); },
          .possible = [](const Model& /*model*/,
                         const Protocol& /*protocol*/) { return from_to(0, 90); },
          .cost_s = cost_of_tilt_s};
}

}  // namespace repose::dem
