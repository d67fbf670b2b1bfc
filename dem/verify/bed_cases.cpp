#include <cmath>

#include <fmt/format.h>

#include "dem/verify/cases.h"
#include "dem/verify/scene.h"

namespace repose::dem {
namespace {

/// Of equal balls, as far from each other as in a large tile.
Wall bed_of(const std::vector<Vector>& centres) {
  SphereBed bed{.spheres = {}, .tile = 100 * kBallRadius_m};
  for (const Vector& centre : centres) {
    bed.spheres.push_back({.centre = centre, .radius = kBallRadius_m});
  }
  Wall wall;
  wall.shape = bed;
  wall.material = 1;
  return wall;
}

/// A ball strikes a fixed one like it head-on: Hertz's impact with half the radius and all of the
/// ball's mass.
void ball_on_fixed_ball(Trial& trial) {
  constexpr double kSpeed = .1;
  for (const double restitution : {1.0, .5}) {
    SimulationSetup setup = ball_scene({.restitution = restitution, .sliding_friction = .3});
    setup.walls = {bed_of({Vector::Zero()})};
    const double mass = setup.contacts.material(0).density_kg_m3 * setup.kinds[0].shape.volume_m3;
    const double young = setup.contacts.law(0, 1).reduced_young_pa;
    Simulation simulation = trial.simulate(setup, kSpeed);
    simulation.add({.position = {0, 0, 2.0001 * kBallRadius_m}, .velocity = {0, 0, -kSpeed}});
    const Collision collision = collide(simulation, Vector::UnitZ(), kBallRadius_m);
    trial.expect(fmt::format("restitution, {:.1f} put in", restitution), restitution,
                 collision.after.velocity.z() / kSpeed, .005);
    if (restitution < 1) continue;
    const double radius = kBallRadius_m / 2;
    const double deepest =
        std::pow(15 * mass * kSpeed * kSpeed / (16 * young * std::sqrt(radius)), .4);
    const double duration =
        2.868266 * std::pow(mass * mass / (radius * young * young * kSpeed), .2);
    trial.expect("deepest overlap, um", 1e6 * deepest, 1e6 * collision.deepest_m,
                 .005 * 1e6 * deepest);
    trial.expect("duration, us", 1e6 * duration, 1e6 * collision.duration_s, .01 * 1e6 * duration);
  }
}

/// A rough ball in the hollow of three balls that touch leaves it between two of them once its
/// weight points over the line of their centres: tan(tilt) = (d / 2 sqrt 3) / (d sqrt(2 / 3)), so
/// that sin(tilt) = 1 / 3, whatever the friction.
void ball_leaves_its_hollow(Trial& trial) {
  constexpr double kRate = 2 * kDegree;  // per second
  constexpr double kStart = 18 * kDegree;
  constexpr double kSettled_s = .3;
  const double across = 2 * kBallRadius_m;
  const double front = across / (2 * std::sqrt(3.0));
  for (const double friction : {.5, 1.0}) {
    SimulationSetup setup = ball_scene({.restitution = .3, .sliding_friction = friction});
    Wall bed = bed_of({{front, across / 2, 0}, {front, -across / 2, 0}, {-2 * front, 0, 0}});
    const Quaternion tilt(Eigen::AngleAxisd(kStart, Vector::UnitY()));
    bed.pose.orientation = tilt;
    setup.walls = {bed};
    setup.gravity = {0, 0, -kStandardGravity_m_s2};
    Simulation simulation = trial.simulate(setup, .1);
    simulation.add(
        {.position = tilt * Vector(0, 0, std::sqrt(2. / 3) * across), .orientation = tilt});
    const auto advance_to = [&simulation](double time) {
      while (simulation.time_s() < time) simulation.advance(20);
    };
    advance_to(kSettled_s);
    simulation.set_motions(0, {{.spin = {0, kRate, 0}, .start_s = kSettled_s}});
    const auto place = [&simulation]() -> Vector {
      return simulation.wall(0).pose.orientation.conjugate() * simulation.grain(0).position;
    };
    const double rest = place().x();
    // From a hundredth of its radius on it is fast: the tilt grows by .2 degrees until then.
    while (place().x() - rest < .01 * kBallRadius_m && simulation.time_s() < 3) {
      simulation.advance(20);
    }
    const double left = kStart + kRate * (simulation.time_s() - kSettled_s);
    trial.expect(fmt::format("leaves at mu {:.1f}, deg", friction), std::asin(1. / 3) / kDegree,
                 left / kDegree, .4);
  }
}

}  // namespace

std::vector<VerifyCase> bed_cases() {
  return {{.name = "ball on a fixed ball",
           .source = "Johnson 1985, section 11.4",
           .run = ball_on_fixed_ball},
          {.name = "ball leaves its hollow",
           .source = "rigid body mechanics",
           .run = ball_leaves_its_hollow}};
}

}  // namespace repose::dem
