#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "dem/verify/cases.h"
#include "dem/verify/oblique.h"
#include "dem/verify/scene.h"

namespace repose::dem {
namespace {

constexpr const char* kChungOoi = "Chung & Ooi (2011)";

/// An impact that slides all the time: the tangential impulse is mu times the normal one.
struct Sliding {
  double restitution;
  double friction;
  double normal_speed;

  /// Tangential speed that is lost.
  double speed_change() const { return friction * (1 + restitution) * normal_speed; }
  /// Spin times radius that comes of it: the moment of inertia of a sphere is 2/5 m r^2.
  double spin_change() const { return 2.5 * speed_change(); }
};

/// T4: angles at which the ball slides throughout.
void slides_over_glass(Trial& trial) {
  for (const double angle_deg : {30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 85.0}) {
    const double angle = angle_deg * kDegree;
    const ObliqueRebound hit = kharaz_impact(trial, angle_deg);
    const Sliding law{kKharazRestitution, kKharazFriction, kKharazSpeed_m_s * std::cos(angle)};
    const double speed = kKharazSpeed_m_s * std::sin(angle);
    trial.expect(fmt::format("tangential restitution at {:.0f} deg", angle_deg),
                 1 - law.speed_change() / speed, hit.tangential_restitution, .005);
    trial.expect(fmt::format("spin at {:.0f} deg, rad/s", angle_deg),
                 law.spin_change() / kKharazRadius_m, hit.spin_rad_s,
                 .01 * law.spin_change() / kKharazRadius_m);
  }
}

/// T4: angles at which the ball sticks for a time; values read off the paper's figures.
void sticks_to_glass(Trial& trial) {
  struct Point {
    double angle_deg, tangential_restitution, spin_rad_s;
    double model;  ///< share by which the spring of the paper's codes differs, see below
  };
  constexpr double kReading = .025;
  // Those codes stretch one spring, F = S_t(now) x. Integrated on its own, it gives .698 and 204
  // rad/s at 10 deg, this engine's .711 and 196; from 15 deg on they agree within 1 %.
  for (const Point& point : {Point{10, .687, 213, .05}, Point{15, .624, 378, 0},
                             Point{20, .616, 511, 0}, Point{25, .634, 599, 0}}) {
    const ObliqueRebound hit = kharaz_impact(trial, point.angle_deg);
    trial.expect(fmt::format("tangential restitution at {:.0f} deg", point.angle_deg),
                 point.tangential_restitution, hit.tangential_restitution,
                 (kReading + point.model) * point.tangential_restitution);
    trial.expect(fmt::format("spin at {:.0f} deg, rad/s", point.angle_deg), point.spin_rad_s,
                 hit.spin_rad_s, (kReading + point.model) * point.spin_rad_s);
  }
}

/// T5: |r w| / (mu v_n) = 2.5 (1 + e).
void elastic_sliding(Trial& trial) {
  constexpr double kRadius = 1e-5;
  constexpr double kNormalSpeed = 5;
  constexpr double kFriction = .3;
  const Material steel{
      .name = "steel", .density_kg_m3 = 7850, .young_modulus_pa = 208e9, .poisson_ratio = .3};
  const SimulationSetup setup =
      scene_of(sphere_shape(kRadius), steel, steel, {.sliding_friction = kFriction});
  for (const double angle_deg : {70.0, 75.0, 80.0, 85.0}) {
    const double across = kNormalSpeed * std::tan(angle_deg * kDegree);
    const Collision hit = strike_wall(trial, setup, {across, 0, -kNormalSpeed});
    trial.expect(fmt::format("r w / (mu v_n) at {:.0f} deg", angle_deg), 5.0,
                 kRadius * hit.after.spin.y() / (kFriction * kNormalSpeed), .025);
  }
}

const Material kAlloy{
    .name = "Al alloy", .density_kg_m3 = 2700, .young_modulus_pa = 70e9, .poisson_ratio = .33};
constexpr double kAlloyRadius = .1;
constexpr Sliding kSpinning{.restitution = .5, .friction = .4, .normal_speed = .2};
constexpr PairCoefficients kSpinningPair{.restitution = .5, .sliding_friction = .4};

/// What is left of a spin about y when it slides on what is below, and the speed that it gave.
void expect_spinning(Trial& trial, double spin, const Grain& after) {
  constexpr double kTolerance = .03;
  const double speed = kSpinning.speed_change();
  trial.expect(fmt::format("tangential speed from {:.0f} rad/s, m/s", spin), speed,
               std::abs(after.velocity.x()), kTolerance * speed);
  const double left = spin - kSpinning.spin_change() / kAlloyRadius;
  trial.expect(fmt::format("spin left of {:.0f} rad/s, rad/s", spin), left,
               std::abs(after.spin.y()), kTolerance * left);
}

/// T6: a spinning sphere falls on a wall.
void spinning_on_wall(Trial& trial) {
  for (const double spin : {8.0, 16.0, 32.0}) {
    const SimulationSetup setup =
        scene_of(sphere_shape(kAlloyRadius), kAlloy, kAlloy, kSpinningPair);
    expect_spinning(trial, spin,
                    strike_wall(trial, setup, {0, 0, -kSpinning.normal_speed}, {0, spin, 0}).after);
  }
}

/// T7: two spheres whose surfaces move alike where they meet.
void opposite_spins(Trial& trial) {
  constexpr double kSpeed = .2;
  for (const double spin : {4.0, 16.0}) {
    Simulation simulation = trial.simulate(
        scene_of(sphere_shape(kAlloyRadius), kAlloy, kAlloy, kSpinningPair), 2 * kSpeed);
    const Vector turn(0, spin, 0);
    simulation.add({.position = {0, 0, kAlloyRadius}, .velocity = {0, 0, -kSpeed}, .spin = turn});
    simulation.add({.position = {0, 0, -kAlloyRadius}, .velocity = {0, 0, kSpeed}, .spin = -turn});
    const Grain after = collide(simulation, Vector::UnitZ(), kAlloyRadius).after;
    trial.expect(fmt::format("tangential speed from {:.0f} rad/s, m/s", spin), 0,
                 after.velocity.head<2>().norm(), .01 * kSpeed);
    trial.expect(fmt::format("spin left of {:.0f} rad/s, rad/s", spin), spin, after.spin.y(),
                 .01 * spin);
  }
}

/// T8: as T6, with a great heavy stiff sphere for the wall.
void spinning_on_great_sphere(Trial& trial) {
  constexpr double kGreatRadius = .5;
  Material great = kAlloy;
  great.name = "heavy alloy";
  great.density_kg_m3 *= 1000;
  great.young_modulus_pa *= 1000;
  for (const double spin : {8.0, 16.0, 32.0}) {
    SimulationSetup setup = scene_of(sphere_shape(kAlloyRadius), kAlloy, great, kSpinningPair);
    setup.kinds.push_back({.shape = sphere_shape(kGreatRadius), .material = 1});
    Simulation simulation = trial.simulate(setup, kSpinning.normal_speed);
    simulation.add({.position = {0, 0, kAlloyRadius},
                    .velocity = {0, 0, -kSpinning.normal_speed},
                    .spin = {0, spin, 0}});
    simulation.add({.kind = 1, .position = {0, 0, -kGreatRadius}});
    expect_spinning(trial, spin, collide(simulation, Vector::UnitZ(), kAlloyRadius).after);
  }
}

}  // namespace

std::vector<VerifyCase> oblique_cases() {
  return {{.name = "T4 oblique, sliding", .source = kChungOoi, .run = slides_over_glass},
          {.name = "T4 oblique, sticking",
           .source = "Chung & Ooi (2011), read off the figures",
           .run = sticks_to_glass},
          {.name = "T5 oblique, elastic", .source = kChungOoi, .run = elastic_sliding},
          {.name = "T6 spinning sphere on a wall", .source = kChungOoi, .run = spinning_on_wall},
          {.name = "T7 opposite spins", .source = kChungOoi, .run = opposite_spins},
          {.name = "T8 spinning sphere on a great sphere",
           .source = kChungOoi,
           .run = spinning_on_great_sphere}};
}

}  // namespace repose::dem
