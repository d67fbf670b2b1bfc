#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "dem/verify/cases.h"
#include "dem/verify/scene.h"

namespace repose::dem {
namespace {

constexpr const char* kChungOoiHertz = "Chung & Ooi (2011); Hertz";

/// Overlap, force and duration are those of a Hertz contact, within .5 %.
struct HertzImpact {
  double deepest_um;
  double peak_kn;
  double duration_us;
};

void expect_hertz(Trial& trial, const HertzImpact& expected, const Collision& measured) {
  constexpr double kTolerance = .005;
  const auto expect = [&trial](const char* quantity, double value, double seen) {
    trial.expect(quantity, value, seen, kTolerance * value);
  };
  expect("deepest overlap, um", expected.deepest_um, measured.deepest_m * 1e6);
  expect("greatest force, kN", expected.peak_kn, measured.peak_n / 1e3);
  expect("duration, us", expected.duration_us, measured.duration_s * 1e6);
}

/// T1: two equal spheres meet head-on.
VerifyCase equal_spheres(const Material& material, const HertzImpact& expected) {
  return {.name = "T1 two spheres, " + material.name,
          .source = kChungOoiHertz,
          .run = [=](Trial& trial) {
            constexpr double kRadius = .01;
            constexpr double kSpeed = 10;
            Simulation simulation =
                trial.simulate(scene_of(sphere_shape(kRadius), material, material, {}), 2 * kSpeed);
            simulation.add({.position = {0, 0, kRadius}, .velocity = {0, 0, -kSpeed}});
            simulation.add({.position = {0, 0, -kRadius}, .velocity = {0, 0, kSpeed}});
            expect_hertz(trial, expected, collide(simulation, Vector::UnitZ(), kRadius));
          }};
}

/// T2: a sphere on a rigid wall.
VerifyCase rigid_wall(const Material& material, const HertzImpact& expected) {
  return {.name = "T2 rigid wall, " + material.name,
          .source = kChungOoiHertz,
          .run = [=](Trial& trial) {
            const Material rigid{
                .name = "rigid", .density_kg_m3 = 1, .young_modulus_pa = 1e20, .poisson_ratio = .3};
            const SimulationSetup setup = scene_of(sphere_shape(.1), material, rigid, {});
            expect_hertz(trial, expected, strike_wall(trial, setup, {0, 0, -.2}));
          }};
}

/// T3: what restitution goes in comes out.
VerifyCase restitution(const Material& material) {
  return {.name = "T3 restitution, " + material.name,
          .source = "Chung & Ooi (2011)",
          .run = [=](Trial& trial) {
            constexpr double kSpeed = 3.9;
            double pull = 0;
            for (const double e : {.05, .1, .2, .3, .4, .5, .6, .7, .8, .9, 1.0}) {
              const SimulationSetup setup =
                  scene_of(sphere_shape(.0025), material, material, {.restitution = e});
              const Collision hit = strike_wall(trial, setup, {0, 0, -kSpeed});
              trial.expect(fmt::format("restitution, set to {:.2f}", e), e,
                           hit.after.velocity.z() / kSpeed, .005);
              pull = std::max(pull, hit.pull_n);
            }
            trial.expect("greatest pull, N", 0, pull, 0);
          }};
}

/// e0 (v / v0)^-alpha comes out where it is asked for: over a hundredfold of speeds, from where it
/// is held at .99 on.
VerifyCase restitution_by_speed(double restitution, double exponent) {
  return {.name = fmt::format("restitution by speed, {:.1f} at 3 m/s, exponent {:.2f}", restitution,
                              exponent),
          .source = "e ~ v^-1/4 at most: Johnson (1985), eq. 11.47",
          .run = [=](Trial& trial) {
            const Material wood{
                .name = "wood", .density_kg_m3 = 700, .young_modulus_pa = 1e9, .poisson_ratio = .3};
            const PairCoefficients pair{.restitution = restitution,
                                        .restitution_exponent = exponent,
                                        .restitution_speed_m_s = 3};
            const SimulationSetup setup = scene_of(sphere_shape(.005), wood, wood, pair);
            for (const double speed : {.001, .03, .3, 1., 3., 6.}) {
              const double expected = restitution_at(pair, speed);
              const Collision hit = strike_wall(trial, setup, {0, 0, -speed});
              trial.expect(fmt::format("restitution at {:g} m/s", speed), expected,
                           hit.after.velocity.z() / speed, .01 * expected);
            }
          }};
}

/// Heights of the centre of mass after each bounce: h_k = (h_0 - r) e^(2k) + r, when the time in
/// contact is short against the flight.
void bounce(Trial& trial) {
  constexpr double kRadius = .1;
  constexpr double kFall = .4;
  constexpr double kRestitution = .9;
  const Material glass{
      .name = "glass", .density_kg_m3 = 2500, .young_modulus_pa = 2e9, .poisson_ratio = .2};
  SimulationSetup setup =
      scene_of(sphere_shape(kRadius), glass, glass, {.restitution = kRestitution});
  setup.walls = {tilted_plane(0)};
  setup.gravity.z() = -kStandardGravity_m_s2;
  Simulation simulation = trial.simulate(setup, std::sqrt(2 * kStandardGravity_m_s2 * kFall));
  simulation.add({.position = {0, 0, kFall + kRadius}});
  for (int k = 1; k <= 5; ++k) {
    double speed = 0;  // upwards
    do {
      speed = simulation.grain(0).velocity.z();
      simulation.advance(1);
    } while (speed <= 0 || simulation.grain(0).velocity.z() > 0);
    const double rise = kFall * std::pow(kRestitution, 2 * k);
    // As if restitution came out wrong by .005.
    trial.expect(fmt::format("height after bounce {}, m", k), rise + kRadius,
                 simulation.grain(0).position.z(), rise * 2 * k * .005 / kRestitution);
  }
}

}  // namespace

std::vector<VerifyCase> impact_cases() {
  const auto material = [](const char* name, double density, double young, double poisson) {
    return Material{.name = name,
                    .density_kg_m3 = density,
                    .young_modulus_pa = young,
                    .poisson_ratio = poisson};
  };
  return {equal_spheres(material("glass", 2800, 48e9, .2), {274.11, 10.697, 40.34}),
          equal_spheres(material("limestone", 2500, 20e9, .25), {368.30, 7.108, 54.20}),
          rigid_wall(material("Al alloy", 2699, 70e9, .3), {49.72, 11.370, 731.7}),
          rigid_wall(material("Mg alloy", 1800, 40e9, .35), {52.12, 7.233, 767.1}),
          restitution(material("Al2O3", 4000, 380e9, .23)),
          restitution(material("cast iron", 7000, 100e9, .25)),
          restitution_by_speed(.4, .1),
          restitution_by_speed(.7, .1),
          restitution_by_speed(.2, .25),
          restitution_by_speed(.6, .25),
          {.name = "bounce heights", .source = "ballistics", .run = bounce}};
}

}  // namespace repose::dem
