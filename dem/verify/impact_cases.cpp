#include "dem/verify/impact_cases.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "dem/verify/scene.h"

namespace repose::dem {

namespace {

constexpr const char* kChungOoiHertz = "Chung & Ooi (2011); Hertz";

/// Overlap, force and duration of a Hertz contact, to agree within .5 %.
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
            const std::vector<Grain> balls = {
                {.position = {0, 0, kRadius}, .velocity = {0, 0, -kSpeed}},
                {.position = {0, 0, -kRadius}, .velocity = {0, 0, kSpeed}}};
            expect_hertz(trial, expected,
                         trial.collide(scene_of(sphere_shape(kRadius), material, material, {}),
                                       balls, 2 * kSpeed, kRadius));
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

/// T3: the restitution measured is the one set.
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

/// e0 (v / v0)^-alpha is reproduced over a hundredfold range of speeds, up to the limit of .99.
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

/// Heights of the centre of mass after each bounce: h_k = (h_0 - r) e^(2k) + r, if the contact is
/// short compared with the flight.
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
  constexpr int kBounces = 5;
  const double fall_s = std::sqrt(2 * kFall / kStandardGravity_m_s2);
  double duration_s = fall_s;  // to the top after the last bounce, with a margin
  for (int k = 1; k <= kBounces; ++k) {
    duration_s += (k < kBounces ? 2 : 1.1) * std::pow(kRestitution, k) * fall_s;
  }
  const Path path = trial.follow(setup, {{.position = {0, 0, kFall + kRadius}}},
                                 fall_s * kStandardGravity_m_s2, duration_s);
  std::vector<double> tops;
  for (std::size_t k = 1; k < path.size(); ++k) {
    const bool turns = path[k - 1].grain.velocity.z() > 0 && path[k].grain.velocity.z() <= 0;
    if (turns) tops.push_back(path[k].grain.position.z());
  }
  tops.resize(kBounces, std::nan(""));
  for (int k = 1; k <= kBounces; ++k) {
    const double rise = kFall * std::pow(kRestitution, 2 * k);
    // Corresponds to an error of .005 in restitution.
    trial.expect(fmt::format("height after bounce {}, m", k), rise + kRadius,
                 tops[static_cast<std::size_t>(k - 1)], rise * 2 * k * .005 / kRestitution);
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

namespace {

// From 20 degrees on the readings scatter by 1 degree, .03 and 8 %. Closer to the normal the
// contact only slips at its rim (Mindlin & Deresiewicz 1953), which the engine's no-slip spring
// neglects: it then returns too much, and the tolerance equals that known error.
struct Shot {
  double impact_deg;
  double value;

  double tolerance(double near_normal, double sliding) const {
    return impact_deg < 15 ? near_normal : sliding;
  }
};

void rebound_angles(Trial& trial) {
  for (const Shot& reading :
       {Shot{.24, .12}, Shot{2.29, 1.76}, Shot{4.29, 2.96}, Shot{9.94, 6.69}, Shot{20.56, 12.36},
        Shot{30.38, 21.78}, Shot{39.62, 32.55}, Shot{49.78, 45.11}, Shot{60.06, 57.37}}) {
    trial.expect(fmt::format("rebound angle at {:.2f} deg, deg", reading.impact_deg), reading.value,
                 kharaz_impact(trial, reading.impact_deg).angle_deg, 1.2);
  }
}

void tangential_restitution(Trial& trial) {
  for (const Shot& reading :
       {Shot{2.03, .794}, Shot{3.93, .745}, Shot{9.63, .673}, Shot{20.08, .596}, Shot{30.22, .688},
        Shot{39.30, .772}, Shot{49.55, .847}, Shot{59.84, .902}}) {
    trial.expect(fmt::format("tangential restitution at {:.2f} deg", reading.impact_deg),
                 reading.value, kharaz_impact(trial, reading.impact_deg).tangential_restitution,
                 reading.tolerance(.13, .04));
  }
}

void spins(Trial& trial) {
  for (const Shot& reading :
       {Shot{5.99, 135.6}, Shot{10.98, 264.5}, Shot{21.19, 577.0}, Shot{31.09, 612.6},
        Shot{39.03, 595.5}, Shot{50.22, 452.9}, Shot{60.25, 381.3}}) {
    trial.expect(fmt::format("spin at {:.2f} deg, rad/s", reading.impact_deg), reading.value,
                 kharaz_impact(trial, reading.impact_deg).spin_rad_s,
                 reading.tolerance(80, .1 * reading.value));
  }
}

}  // namespace

ObliqueRebound kharaz_impact(Trial& trial, double angle_deg) {
  const Material alumina{
      .name = "Al2O3", .density_kg_m3 = 4000, .young_modulus_pa = 380e9, .poisson_ratio = .23};
  const Material glass{
      .name = "glass", .density_kg_m3 = 2500, .young_modulus_pa = 70e9, .poisson_ratio = .25};
  const SimulationSetup setup =
      scene_of(sphere_shape(kKharazRadius_m), alumina, glass,
               {.restitution = kKharazRestitution, .sliding_friction = kKharazFriction});
  const double across = kKharazSpeed_m_s * std::sin(angle_deg * kDegree);
  const double down = kKharazSpeed_m_s * std::cos(angle_deg * kDegree);
  const Grain after = strike_wall(trial, setup, {across, 0, -down}).after;
  return {.tangential_restitution = after.velocity.x() / across,
          .angle_deg = std::atan2(after.velocity.x(), after.velocity.z()) / kDegree,
          .spin_rad_s = after.spin.y()};
}

std::vector<VerifyCase> kharaz_cases() {
  constexpr const char* kSource = "Kharaz et al. (2001), experiment";
  return {
      {.name = "Kharaz, rebound angle", .source = kSource, .run = rebound_angles},
      {.name = "Kharaz, tangential restitution", .source = kSource, .run = tangential_restitution},
      {.name = "Kharaz, spin", .source = kSource, .run = spins}};
}

namespace {

constexpr const char* kChungOoi = "Chung & Ooi (2011)";

/// An impact that slides throughout: the tangential impulse is mu times the normal one.
struct Sliding {
  double restitution;
  double friction;
  double normal_speed;

  /// Loss of tangential speed.
  double speed_change() const { return friction * (1 + restitution) * normal_speed; }
  /// Resulting spin times radius: the moment of inertia of a sphere is 2/5 m r^2.
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
    double model;  ///< relative deviation due to the spring of the paper's codes, see below
  };
  constexpr double kReading = .025;
  // Those codes use a single spring, F = S_t(now) x. Integrated separately, it gives .698 and 204
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

/// Remaining spin about y after sliding contact, and the tangential speed that it gave.
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

/// T7: two spheres whose surfaces move equally at the contact.
void opposite_spins(Trial& trial) {
  constexpr double kSpeed = .2;
  for (const double spin : {4.0, 16.0}) {
    const Vector turn(0, spin, 0);
    const std::vector<Grain> balls = {
        {.position = {0, 0, kAlloyRadius}, .velocity = {0, 0, -kSpeed}, .spin = turn},
        {.position = {0, 0, -kAlloyRadius}, .velocity = {0, 0, kSpeed}, .spin = -turn}};
    const Grain after =
        trial
            .collide(scene_of(sphere_shape(kAlloyRadius), kAlloy, kAlloy, kSpinningPair), balls,
                     2 * kSpeed, kAlloyRadius)
            .after;
    trial.expect(fmt::format("tangential speed from {:.0f} rad/s, m/s", spin), 0,
                 after.velocity.head<2>().norm(), .01 * kSpeed);
    trial.expect(fmt::format("spin left of {:.0f} rad/s, rad/s", spin), spin, after.spin.y(),
                 .01 * spin);
  }
}

/// T8: as T6, with a large, heavy, stiff sphere instead of the wall.
void spinning_on_great_sphere(Trial& trial) {
  constexpr double kGreatRadius = .5;
  Material great = kAlloy;
  great.name = "heavy alloy";
  great.density_kg_m3 *= 1000;
  great.young_modulus_pa *= 1000;
  for (const double spin : {8.0, 16.0, 32.0}) {
    SimulationSetup setup = scene_of(sphere_shape(kAlloyRadius), kAlloy, great, kSpinningPair);
    setup.kinds.push_back({.shape = sphere_shape(kGreatRadius), .material = 1});
    const std::vector<Grain> balls = {{.position = {0, 0, kAlloyRadius},
                                       .velocity = {0, 0, -kSpinning.normal_speed},
                                       .spin = {0, spin, 0}},
                                      {.kind = 1, .position = {0, 0, -kGreatRadius}}};
    expect_spinning(trial, spin,
                    trial.collide(setup, balls, kSpinning.normal_speed, kAlloyRadius).after);
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
