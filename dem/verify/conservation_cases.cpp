#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dem/contact/model_names.h"
#include "dem/contact/restitution.h"
#include "dem/verify/scene.h"

namespace repose::dem {

namespace {

const Material kSteel{
    .name = "steel", .density_kg_m3 = 7850, .young_modulus_pa = 208e9, .poisson_ratio = .3};

/// A ball that strikes a wall, or an equal ball, at `angle` from the normal; first contact is at
/// `late` of a step after the start.
struct Impact {
  static constexpr double kRadius = .005, kSpeed = 2;
  bool on_ball;
  double angle;
  double late;

  Vector velocity(double speed) const {
    return {speed * std::sin(angle), 0, -speed * std::cos(angle)};
  }
  Meeting meeting(double speed, double timestep_s) const {
    Grain ball;
    ball.velocity = velocity(speed);
    ball.position.z() = kRadius - late * timestep_s * ball.velocity.z();
    if (!on_ball) return {ball};
    return {ball, {.position = {0, 0, -kRadius}}};
  }
};

/// Twice the kinetic energy of a ball per mass.
double energy2_of(const Grain& ball) {
  return ball.velocity.squaredNorm() +
         .4 * Impact::kRadius * Impact::kRadius * ball.spin.squaredNorm();
}

/// Relative kinetic energy created in an elastic impact at any angle; friction can only reduce it.
/// A spring of the total slip, S_t(now) x, would create 3 % at nu 0 and mu 3.
void energy_of_oblique_impacts(Trial& trial) {
  constexpr int kPhases = 16;
  for (const bool on_ball : {false, true}) {
    for (const auto& [poisson, friction] : {std::pair{0.0, .3}, {0.0, 3.0}, {.3, .3}, {.3, 1.0}}) {
      Material material = kSteel;
      material.poisson_ratio = poisson;
      SimulationSetup setup = scene_of(sphere_shape(Impact::kRadius), material, material,
                                       {.sliding_friction = friction});
      if (!on_ball) setup.walls = {tilted_plane(0)};
      std::vector<Meeting> meetings;
      for (int k = 0; k < 90 + kPhases; ++k) {
        const int angle_deg = std::max(0, k - kPhases);  // 0 degrees at every phase
        const Impact impact{on_ball, angle_deg * kDegree, k % kPhases / double{kPhases}};
        meetings.push_back(impact.meeting(Impact::kSpeed, trial.timestep_s(setup, Impact::kSpeed)));
      }
      double most = 0;
      for (const Collision& hit :
           trial.collide_each(setup, meetings, Impact::kSpeed, Impact::kRadius)) {
        // Per mass of a ball; a wall has no energy.
        const double energy2 = energy2_of(hit.after) + (on_ball ? energy2_of(hit.struck) : 0);
        most = std::max(most, energy2 / (Impact::kSpeed * Impact::kSpeed) - 1);
      }
      trial.expect(fmt::format("energy made on a {}, nu {:.1f}, mu {:.1f}, J/J",
                               on_ball ? "ball" : "wall", poisson, friction),
                   0, most, 1e-4);
    }
  }
}

/// For contacts that begin anywhere in a step, and slower impacts than the step is meant for.
void restitution_at_any_step(Trial& trial) {
  for (const bool on_ball : {false, true}) {
    double worst = 0;
    double pull = 0;
    for (const double e : {.05, .1, .2, .3, .5, .7, .9, 1.0}) {
      SimulationSetup setup =
          scene_of(sphere_shape(Impact::kRadius), kSteel, kSteel, {.restitution = e});
      if (!on_ball) setup.walls = {tilted_plane(0)};
      const double timestep_s = trial.timestep_s(setup, Impact::kSpeed);
      for (const double speed : {Impact::kSpeed, .05}) {
        std::vector<Meeting> meetings;
        for (const double late : {0.0, .2, .4, .6, .8}) {
          meetings.push_back(Impact{on_ball, 0, late}.meeting(speed, timestep_s));
        }
        for (const Collision& hit :
             trial.collide_each(setup, meetings, Impact::kSpeed, Impact::kRadius)) {
          const double other = on_ball ? hit.struck.velocity.z() : 0;
          const double out = (hit.after.velocity.z() - other) / speed;
          worst = std::max(worst, std::abs(out - e));
          pull = std::max(pull, hit.pull_n);
        }
      }
    }
    const std::string where = on_ball ? "ball" : "wall";
    trial.expect("worst |e out - e in| on a " + where, 0, worst, .005);
    trial.expect("greatest pull of a " + where + ", N", 0, pull, 0);
  }
}

Vector momentum_of(const Simulation& simulation) {
  Vector sum = Vector::Zero();
  for (int k = 0; k < simulation.grain_count(); ++k) {
    sum += simulation.mass_kg(k) * simulation.grain(k).velocity;
  }
  return sum;
}

/// About the origin.
Vector angular_momentum_of(const Simulation& simulation) {
  const Checkpoint now = simulation.checkpoint();
  Vector sum = Vector::Zero();
  for (std::size_t k = 0; k < now.grains.size(); ++k) {
    const Grain& grain = now.grains[k];
    sum += now.angular_momentum[k] +
           simulation.mass_kg(static_cast<int>(k)) * grain.position.cross(grain.velocity);
  }
  return sum;
}

/// Blocks that collide from all sides, each with its own orientation and spin.
void momentum_of_many_clumps(Trial& trial) {
  const Material wood{
      .name = "wood", .density_kg_m3 = 700, .young_modulus_pa = 1e7, .poisson_ratio = .3};
  const ClumpShape block = block_shape({.012, .008, .005}, .004);
  const PairCoefficients pair{.restitution = .4, .sliding_friction = .5, .rolling_friction = .1};
  Simulation simulation =
      trial.simulate(scene_of(block, wood, wood, pair, RollingModel::relative_constant_torque), 3);
  double linear_scale = 0;
  double angular_scale = 0;
  for (int k = 0; k < 64; ++k) {
    const Eigen::Vector3i at(k % 4, k / 4 % 4, k / 16);
    const Vector cell = at.cast<double>() - Vector::Constant(1.5);
    const Vector turn(std::sin(k), std::sin(2.1 * k), std::sin(3.3 * k));
    Grain grain;
    grain.position = .035 * cell;
    grain.orientation = Eigen::AngleAxisd(k, turn.normalized());
    grain.velocity = -cell + .3 * turn;
    grain.spin = 20 * turn;
    simulation.add(grain);
    linear_scale += simulation.mass_kg(k) * grain.velocity.norm();
    angular_scale += simulation.mass_kg(k) * grain.position.cross(grain.velocity).norm();
  }
  const Vector linear = momentum_of(simulation);
  const Vector angular = angular_momentum_of(simulation);
  std::set<int> met;
  while (simulation.time_s() < .08) {
    simulation.advance(10);
    for (const ContactState& contact : simulation.contacts()) {
      met.insert({contact.grain_a, contact.grain_b});
    }
  }
  trial.expect("momentum drift, relative", 0,
               (momentum_of(simulation) - linear).norm() / linear_scale, 1e-12);
  trial.expect("angular momentum drift, relative", 0,
               (angular_momentum_of(simulation) - angular).norm() / angular_scale, 1e-12);
  trial.expect("clumps that met another", simulation.grain_count(), static_cast<double>(met.size()),
               0);
}

}  // namespace

std::vector<VerifyCase> conservation_cases() {
  return {{.name = "energy of elastic oblique impacts",
           .source = "conservation of energy",
           .run = energy_of_oblique_impacts},
          {.name = "restitution at any step",
           .source = "definition of restitution",
           .run = restitution_at_any_step},
          {.name = "momentum of colliding clumps",
           .source = "Newton's third law",
           .run = momentum_of_many_clumps}};
}

namespace {

/// A bed of equal balls in a large tile.
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

/// A ball strikes an equal, fixed one head-on: Hertz impact with half the radius and the ball's
/// full mass.
void ball_on_fixed_ball(Trial& trial) {
  constexpr double kSpeed = .1;
  for (const double restitution : {1.0, .5}) {
    SimulationSetup setup = ball_scene({.restitution = restitution, .sliding_friction = .3});
    setup.walls = {bed_of({Vector::Zero()})};
    const double mass = setup.contacts.material(0).density_kg_m3 * setup.kinds[0].shape.volume_m3;
    const double young = setup.contacts.law(0, 1).reduced_young_pa;
    const std::vector<Grain> balls = {
        {.position = {0, 0, 2.0001 * kBallRadius_m}, .velocity = {0, 0, -kSpeed}}};
    const Collision collision = trial.collide(setup, balls, kSpeed, kBallRadius_m);
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

/// A rough ball in the hollow of three touching balls leaves it between two of them once its weight
/// vector passes the line of their centres: tan(tilt) = (d / 2 sqrt 3) / (d sqrt(2 / 3)), so that
/// sin(tilt) = 1 / 3, whatever the friction.
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
    // After a hundredth of its radius it moves fast; the tilt grows by .2 degrees until then.
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

namespace {

constexpr double kLandingSpeed = 1;
constexpr double kHalfHeight = .01;
constexpr double kCornerRadius = .005;
constexpr double kClumpTolerance = .005;

/// A block that lands flat on the spheres in its four lower corners.
ClumpShape flat_block() { return block_shape({.02, .02, kHalfHeight}, kCornerRadius); }

/// The same with more spheres beneath, each group `step_m` higher than the previous one, so that
/// they make contact one after another.
ClumpShape block_of_rings(double step_m) {
  ClumpShape shape = flat_block();
  const auto add = [&](double x, double y, int ring) {
    const double z = -kHalfHeight + kCornerRadius + ring * step_m;
    shape.spheres.push_back({.centre = {x, y, z}, .radius = kCornerRadius});
  };
  add(0, 0, 1);
  for (const double side : {-1.0, 1.0}) {
    add(side * .006, 0, 2);
    add(0, side * .006, 3);
    add(side * .012, 0, 4);
    add(0, side * .012, 5);
  }
  return shape;
}

Collision landing_of(Trial& trial, const ClumpShape& shape, double restitution,
                     DampingModel damping, bool on_block) {
  const Material wood{
      .name = "wood", .density_kg_m3 = 700, .young_modulus_pa = 1e8, .poisson_ratio = .3};
  SimulationSetup setup =
      scene_of(shape, wood, wood, {.restitution = restitution}, RollingModel::none, damping);
  if (!on_block) setup.walls = {tilted_plane(0)};
  std::vector<Grain> blocks = {
      {.position = {0, 0, kHalfHeight}, .velocity = {0, 0, -kLandingSpeed}}};
  if (on_block) {
    Grain struck;
    struck.position.z() = -kHalfHeight;
    struck.orientation = Eigen::AngleAxisd(std::acos(-1.0), Vector::UnitX());
    blocks.push_back(struck);
  }
  return trial.collide(std::move(setup), blocks, kLandingSpeed, kCornerRadius);
}

/// Compares the restitution of a clump that lands flat with the expected one.
void expect_restitution(Trial& trial, const ClumpShape& shape, DampingModel damping,
                        const std::function<double(double)>& restitution_for, bool on_block) {
  double pull = 0;
  const std::string where = on_block ? "block" : "wall";
  for (const double e : {.1, .4, .8}) {
    const Collision hit = landing_of(trial, shape, e, damping, on_block);
    const double other = on_block ? hit.struck.velocity.z() : 0;
    trial.expect(fmt::format("restitution on a {}, set to {:.2f}", where, e), restitution_for(e),
                 (hit.after.velocity.z() - other) / kLandingSpeed, kClumpTolerance);
    pull = std::max(pull, hit.pull_n);
  }
  trial.expect(fmt::format("greatest pull of a {}, N", where), 0, pull, 0);
}

VerifyCase landing(const std::string& name, const ClumpShape& shape, DampingModel damping,
                   const std::function<double(double)>& restitution_for) {
  return {.name = fmt::format("{}, {} damping", name, name_of(damping)),
          .source = "impact of a Hertz contact",
          .run = [=](Trial& trial) {
            for (const bool on_block : {false, true}) {
              expect_restitution(trial, shape, damping, restitution_for, on_block);
            }
          }};
}

}  // namespace

std::vector<VerifyCase> clump_cases() {
  constexpr int kContacts = 4;
  const auto as_set = [](double e) { return e; };
  // Equal contacts, each with the whole mass, act as one contact with sqrt(N) times the factor.
  const auto of_factors = [](double e) {
    return restitution_of(std::sqrt(kContacts) * damping_factor(e));
  };
  constexpr double kStep = 2e-5;  // a tenth of the deepest overlap
  return {
      landing("four spheres at once", flat_block(), DampingModel::per_contact, of_factors),
      landing("four spheres at once", flat_block(), DampingModel::shared, as_set),
      landing("spheres one after another", block_of_rings(kStep), DampingModel::shared, as_set)};
}

}  // namespace repose::dem
