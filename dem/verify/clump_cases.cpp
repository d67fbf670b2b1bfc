#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dem/contact/damping_name.h"
#include "dem/contact/restitution.h"
#include "dem/verify/cases.h"
#include "dem/verify/scene.h"

namespace repose::dem {
namespace {

constexpr double kLandingSpeed = 1;
constexpr double kHalfHeight = .01;
constexpr double kCornerRadius = .005;
constexpr double kClumpTolerance = .005;

/// A block that lands flat on the spheres in its four lower corners.
ClumpShape flat_block() { return block_shape({.02, .02, kHalfHeight}, kCornerRadius); }

/// The same with more spheres beneath, each ring `step_m` higher than the one before: they begin to
/// touch one after another.
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

Simulation clump_scene(Trial& trial, const ClumpShape& shape, double restitution,
                       DampingModel damping, bool on_block) {
  const Material wood{
      .name = "wood", .density_kg_m3 = 700, .young_modulus_pa = 1e8, .poisson_ratio = .3};
  SimulationSetup setup =
      scene_of(shape, wood, wood, {.restitution = restitution}, RollingModel::none, damping);
  if (!on_block) setup.walls = {tilted_plane(0)};
  Simulation simulation = trial.simulate(std::move(setup), kLandingSpeed);
  Grain falling;
  falling.position.z() = kHalfHeight;
  falling.velocity.z() = -kLandingSpeed;
  simulation.add(falling);
  if (on_block) {
    Grain struck;
    struck.position.z() = -kHalfHeight;
    struck.orientation = Eigen::AngleAxisd(std::acos(-1.0), Vector::UnitX());
    simulation.add(struck);
  }
  return simulation;
}

/// What a clump that lands flat keeps of its speed, against what it should.
void expect_restitution(Trial& trial, const ClumpShape& shape, DampingModel damping,
                        const std::function<double(double)>& restitution_for, bool on_block) {
  double pull = 0;
  const std::string where = on_block ? "block" : "wall";
  for (const double e : {.1, .4, .8}) {
    Simulation simulation = clump_scene(trial, shape, e, damping, on_block);
    const Collision hit = collide(simulation, Vector::UnitZ(), kCornerRadius);
    const double other = on_block ? simulation.grain(1).velocity.z() : 0;
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
  // Equal contacts of the whole mass each: one contact with sqrt(N) times the factor.
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
