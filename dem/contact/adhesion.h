#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/units.h"

/// Whether real dry grains would stick to each other; simulated ones never do.
namespace repose::dem {

/// Work of adhesion of rough dry grains by van der Waals forces, J/m2, if not known: pull-off
/// forces A r / (6 z^2) of asperities of r = 0.1 and 1 um (A = 6.5e-20 J, z = .4 nm: Israelachvili,
/// Intermolecular and Surface Forces, 3rd ed. 2011, chapters 11 and 13), converted for a grain of
/// 0.1 mm by the theory below. Ideally smooth surfaces have 100 times as much; grains do not reach
/// that.
inline constexpr double kRoughestAdhesion_j_m2 = 6e-5;
inline constexpr double kSmoothestAdhesion_j_m2 = 6e-4;

/// Bond number: the force that pulls a grain off an equal one, 3/2 pi W R* (Johnson, Kendall,
/// Roberts 1971, Proc. R. Soc. A 324, 301), R* = d / 4, divided by its weight, pi / 6 q d^3 g, q
/// its density: 9 W / (4 q g d^2). Above 1 a grain can hang from another. Proved by Adhesion.* in
/// tests/dem/adhesion_test.cpp.
inline double bond_number(double diameter_m, double density_kg_m3, double adhesion_j_m2) {
  return 9 * adhesion_j_m2 / (4 * density_kg_m3 * kStandardGravity_m_s2 * diameter_m * diameter_m);
}

/// Warning about results for grains of this volume; std::nullopt if they are large enough.
inline std::optional<std::string> adhesion_warning(double volume_m3, double density_kg_m3) {
  const double diameter_m = std::cbrt(6 / std::numbers::pi * volume_m3);
  const double least = bond_number(diameter_m, density_kg_m3, kRoughestAdhesion_j_m2);
  const double most = bond_number(diameter_m, density_kg_m3, kSmoothestAdhesion_j_m2);
  if (most < 1) return std::nullopt;
  return fmt::format(
      "grains of {:.3g} mm and {:g} kg/m3 {} stick to each other even when they are dry, and the "
      "simulation has no cohesion: pull-off force by weight (Bond number) is {:.2g} to {:.2g}, for "
      "works of adhesion of {:g} to {:g} J/m2 that are typical of rough surfaces, not measured. "
      "Heaps of such grains stand steeper, fills are looser, and coefficients fitted to them stand "
      "for their cohesion, too",
      1e3 * diameter_m, density_kg_m3, least > 1 ? "would" : "may", least, most,
      kRoughestAdhesion_j_m2, kSmoothestAdhesion_j_m2);
}

}  // namespace repose::dem
