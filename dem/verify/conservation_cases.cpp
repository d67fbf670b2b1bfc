#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "dem/verify/cases.h"
#include "dem/verify/scene.h"

namespace repose::dem {
namespace {

const Material kSteel{
    .name = "steel", .density_kg_m3 = 7850, .young_modulus_pa = 208e9, .poisson_ratio = .3};

/// A ball that strikes a wall, or a ball like itself, at `angle` from the normal; first contact
/// falls `late` of a step after the start.
struct Impact {
  static constexpr double kRadius = .005, kSpeed = 2;
  bool on_ball;
  double angle;
  double late;

  Vector velocity(double speed) const {
    return {speed * std::sin(angle), 0, -speed * std::cos(angle)};
  }
  /// `accepted_speed`: what the time step is chosen for.
  Simulation start(Trial& trial, SimulationSetup setup, double speed, double accepted_speed) const {
    if (!on_ball) setup.walls = {tilted_plane(0)};
    Simulation simulation = trial.simulate(std::move(setup), accepted_speed);
    Grain ball;
    ball.velocity = velocity(speed);
    ball.position.z() = kRadius - late * simulation.setup().timestep_s * ball.velocity.z();
    simulation.add(ball);
    if (on_ball) {
      Grain struck;
      struck.position.z() = -kRadius;
      simulation.add(struck);
    }
    return simulation;
  }
};

/// Kinetic energy that appears in an elastic impact at any angle, relative; friction only takes.
/// A spring of the total slip, S_t(now) x, makes 3 % at nu 0 and mu 3.
void energy_of_oblique_impacts(Trial& trial) {
  constexpr int kPhases = 16;
  for (const bool on_ball : {false, true}) {
    for (const auto& [poisson, friction] : {std::pair{0.0, .3}, {0.0, 3.0}, {.3, .3}, {.3, 1.0}}) {
      Material material = kSteel;
      material.poisson_ratio = poisson;
      const SimulationSetup setup = scene_of(sphere_shape(Impact::kRadius), material, material,
                                             {.sliding_friction = friction});
      double most = 0;
      for (int k = 0; k < 90 + kPhases; ++k) {
        const int angle_deg = std::max(0, k - kPhases);  // 0: at every phase
        const Impact impact{on_ball, angle_deg * kDegree, k % kPhases / double{kPhases}};
        Simulation simulation = impact.start(trial, setup, Impact::kSpeed, Impact::kSpeed);
        collide(simulation, Vector::UnitZ(), Impact::kRadius);
        const double start = .5 * simulation.mass_kg(0) * Impact::kSpeed * Impact::kSpeed;
        most = std::max(most, simulation.energies().kinetic_j / start - 1);
      }
      trial.expect(fmt::format("energy made on a {}, nu {:.1f}, mu {:.1f}, J/J",
                               on_ball ? "ball" : "wall", poisson, friction),
                   0, most, 1e-4);
    }
  }
}

/// Wherever in a step the contact begins, and in slower impacts than the step is meant for.
void restitution_at_any_step(Trial& trial) {
  for (const bool on_ball : {false, true}) {
    double worst = 0;
    double pull = 0;
    for (const double e : {.05, .1, .2, .3, .5, .7, .9, 1.0}) {
      const SimulationSetup setup =
          scene_of(sphere_shape(Impact::kRadius), kSteel, kSteel, {.restitution = e});
      for (const double speed : {2.0, .05}) {
        for (const double late : {0.0, .2, .4, .6, .8}) {
          Simulation simulation =
              Impact{on_ball, 0, late}.start(trial, setup, speed, Impact::kSpeed);
          const Collision hit = collide(simulation, Vector::UnitZ(), Impact::kRadius);
          const double other = on_ball ? simulation.grain(1).velocity.z() : 0;
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

/// Blocks that fly together from all sides, each turned and spinning in its own way.
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

}  // namespace repose::dem
