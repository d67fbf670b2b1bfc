#include <cmath>

#include <fmt/format.h>

#include "dem/verify/cases.h"
#include "dem/verify/scene.h"

namespace repose::dem {
namespace {

constexpr double kLowRestitution = .5;  // damps what the start stirs up

/// A sphere set down sliding: slip ends after 2 u0 / (7 mu g), with 5/7 of the speed.
void slip_to_roll(Trial& trial) {
  constexpr double kSpeed = .1;
  for (const double friction : {.2, .4, .6, .8, 1.0}) {
    SimulationSetup setup =
        ball_scene({.restitution = kLowRestitution, .sliding_friction = friction});
    setup.walls = {tilted_plane(0)};
    setup.gravity = {0, 0, -kStandardGravity_m_s2};
    Simulation simulation = trial.simulate(setup, kSpeed);
    Grain ball = resting_sphere(setup, 0);
    ball.velocity.x() = kSpeed;
    simulation.add(ball);
    const auto slip = [&simulation] {
      const Grain now = simulation.grain(0);
      return now.velocity.x() - kBallRadius_m * now.spin.y();
    };
    double before = kSpeed;
    for (; slip() > 0; simulation.advance(1)) before = slip();
    const double part = before / (before - slip());
    const double time = simulation.time_s() - (1 - part) * simulation.setup().timestep_s;
    const double expected = 2 * kSpeed / (7 * friction * kStandardGravity_m_s2);
    trial.expect(fmt::format("slip ends at mu {:.1f}, ms", friction), 1e3 * expected, 1e3 * time,
                 .01 * 1e3 * expected);
    while (simulation.time_s() < 10 * expected) simulation.advance(1);
    const Grain rolling = simulation.grain(0);
    trial.expect(fmt::format("u / u0 at last, mu {:.1f}", friction), 5.0 / 7,
                 rolling.velocity.x() / kSpeed, .002);
    trial.expect(fmt::format("r w / u0 at last, mu {:.1f}", friction), 5.0 / 7,
                 kBallRadius_m * rolling.spin.y() / kSpeed, .002);
  }
}

/// A sphere let go on an incline rolls if tan(tilt) <= 3.5 mu, else it slides as well.
void sphere_on_incline(Trial& trial) {
  constexpr double kTilt = 20 * kDegree;
  constexpr double kTime = .1;
  for (const double friction : {.05, .1, .2, .5, 1.0}) {
    SimulationSetup setup =
        ball_scene({.restitution = kLowRestitution, .sliding_friction = friction});
    setup.walls = {tilted_plane(kTilt)};
    setup.gravity = {0, 0, -kStandardGravity_m_s2};
    Simulation simulation = trial.simulate(setup, .1);
    simulation.add(resting_sphere(setup, kTilt));
    const auto speed_at = [&](double time) {
      while (simulation.time_s() < time) simulation.advance(1);
      return simulation.grain(0).velocity.dot(downhill(kTilt));
    };
    // The springs stretch first: the speed is counted from half-time on.
    const double start = speed_at(kTime);
    const double start_s = simulation.time_s();
    const double gained = speed_at(2 * kTime) - start;
    const double expected =
        std::tan(kTilt) <= 3.5 * friction
            ? 5.0 / 7 * kStandardGravity_m_s2 * std::sin(kTilt)
            : kStandardGravity_m_s2 * (std::sin(kTilt) - friction * std::cos(kTilt));
    trial.expect(fmt::format("acceleration at mu {:.2f}, m/s2", friction), expected,
                 gained / (simulation.time_s() - start_s), .002 * expected);
  }
}

/// A flat block on a plate that is tilted slowly sets off at atan(mu).
void block_on_tilting_plate(Trial& trial) {
  constexpr double kRate = 1 * kDegree;    // per second
  constexpr double kStart = .5 * kDegree;  // short of atan(mu)
  constexpr double kMoved = 1e-6;
  const Material soft{
      .name = "soft", .density_kg_m3 = 1000, .young_modulus_pa = 5e7, .poisson_ratio = .3};
  const ClumpShape block = block_shape({.02, .02, .005}, .004);
  for (const double friction : {.2, .5}) {
    SimulationSetup setup =
        scene_of(block, soft, soft, {.restitution = .1, .sliding_friction = friction});
    const double start = std::atan(friction) - kStart;
    setup.walls = {tilted_plane(start)};
    setup.gravity = {0, 0, -kStandardGravity_m_s2};
    Simulation simulation = trial.simulate(setup, .05);
    Grain grain;
    const Vector up(std::sin(start), 0, std::cos(start));
    grain.position = up * .005;
    grain.orientation = Eigen::AngleAxisd(start, Vector::UnitY());
    simulation.add(grain);
    const auto advance_to = [&simulation](double time) {
      while (simulation.time_s() < time) simulation.advance(20);
    };
    advance_to(.1);  // it settles
    simulation.set_motions(0, {{.spin = {0, kRate, 0}, .start_s = .1}});
    const auto place = [&simulation]() -> Vector {
      return simulation.wall(0).pose.orientation.conjugate() * simulation.grain(0).position;
    };
    advance_to(.15);
    const double rest = place().x();
    while (place().x() - rest < kMoved && simulation.time_s() < 3) simulation.advance(20);
    const double tilt = start + kRate * (simulation.time_s() - .1);
    trial.expect(fmt::format("sets off at mu {:.1f}, deg", friction), std::atan(friction) / kDegree,
                 tilt / kDegree, .05);
  }
}

}  // namespace

std::vector<VerifyCase> motion_cases() {
  constexpr const char* kSource = "rigid body mechanics, Coulomb";
  return {{.name = "slip to roll", .source = kSource, .run = slip_to_roll},
          {.name = "sphere on an incline", .source = kSource, .run = sphere_on_incline},
          {.name = "block on a tilting plate", .source = kSource, .run = block_on_tilting_plate}};
}

}  // namespace repose::dem
