#include <algorithm>
#include <cmath>

#include <boost/math/special_functions/ellint_1.hpp>
#include <fmt/format.h>

#include "dem/verify/cases.h"
#include "dem/verify/scene.h"

namespace repose::dem {
namespace {

/// How a free body with principal moments A < B < C tumbles.
///
/// Source: Landau & Lifshitz, Mechanics, sec. 37: with M^2 > 2 E B
///   period T = 4 K(k) sqrt(A B C / ((C - B)(M^2 - 2 E A))),
///   k^2 = (B - A)(2 E C - M^2) / ((C - B)(M^2 - 2 E A));
/// with M^2 < 2 E B, A and C change places.
double tumbling_period(Vector moments, const Vector& spin) {
  const double energy2 = moments.dot(spin.cwiseAbs2());
  const double momentum2 = moments.cwiseProduct(spin).squaredNorm();
  if (momentum2 < energy2 * moments.y()) std::swap(moments.x(), moments.z());
  const double a = moments.x();
  const double b = moments.y();
  const double c = moments.z();
  const double rate = (c - b) * (momentum2 - energy2 * a);
  const double k2 = (b - a) * (energy2 * c - momentum2) / rate;
  return 4 * boost::math::ellint_1(std::sqrt(k2)) * std::sqrt(a * b * c / rate);
}

/// A block thrown spinning about its middle axis turns over again and again (Dzhanibekov).
void tumbling(Trial& trial) {
  const Material wood{
      .name = "wood", .density_kg_m3 = 700, .young_modulus_pa = 1e8, .poisson_ratio = .3};
  const ClumpShape block = block_shape({.03, .02, .01}, .005);
  const Vector spin(.5, 50, .3);
  Simulation simulation = trial.simulate(scene_of(block, wood, wood, {}), 1);
  simulation.add({.spin = spin});
  const double mass = simulation.mass_kg(0);
  const Vector moments = mass * block.gyration_m2;
  const double energy = simulation.energies().kinetic_j;
  const Vector momentum = moments.cwiseProduct(spin);

  const auto middle_spin = [&simulation] {
    const Grain now = simulation.grain(0);
    return (now.orientation.conjugate() * now.spin).y();
  };
  double worst_energy = 0;
  double worst_momentum = 0;
  std::vector<double> turns;  // times at which the spin about the middle axis is zero
  for (double before = middle_spin(); turns.size() < 5;) {
    simulation.advance(1);
    const double now = middle_spin();
    if (before * now < 0) {
      turns.push_back(simulation.time_s() - simulation.setup().timestep_s * now / (now - before));
    }
    before = now;
    const Grain grain = simulation.grain(0);
    const Vector own = grain.orientation.conjugate() * grain.spin;
    const Vector own_momentum = grain.orientation * moments.cwiseProduct(own);
    worst_momentum = std::max(worst_momentum, (own_momentum - momentum).norm());
    worst_energy = std::max(worst_energy, std::abs(simulation.energies().kinetic_j - energy));
  }
  const double expected = tumbling_period(moments, spin);
  trial.expect("period, s", expected, (turns[4] - turns[0]) / 2, 1e-4 * expected);
  trial.expect("energy drift, J/J", 0, worst_energy / energy, 1e-6);
  trial.expect("angular momentum drift, relative", 0, worst_momentum / momentum.norm(), 1e-12);
}

}  // namespace

std::vector<VerifyCase> rotation_cases() {
  return {{.name = "tumbling free block",
           .source = "Landau & Lifshitz, Mechanics, sec. 37",
           .run = tumbling}};
}

}  // namespace repose::dem
