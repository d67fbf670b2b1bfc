#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

/// What is typical of kinds of grain and plate: to begin a study with, until it is measured.
namespace repose::calibrate {

struct CoefficientBounds {
  double min = 0;
  double max = 0;
};

/// Between which a contact's coefficients are looked for.
struct ContactBounds {
  CoefficientBounds restitution;
  CoefficientBounds sliding_friction;
  CoefficientBounds rolling_friction;
};

struct GrainKind {
  std::string_view name;             ///< as typed: "soybean"
  std::string_view plural;           ///< "soybeans"
  std::array<double, 3> sizes = {};  ///< length, width, thickness, mm
  double density_kg_m3 = 0;
  double young_modulus_pa = 0;  ///< apparent, of a whole grain
  double poisson_ratio = 0;
  ContactBounds with_wall;
  ContactBounds with_grain;
  std::array<int, 3> colour = {};  ///< about that of the grains: red, green, blue, 0 to 255
  std::string_view source;         ///< of the bounds; empty: they are wide, and of no one kind
};

struct PlateKind {
  std::string_view name;  ///< as typed: "acrylic"
  double density_kg_m3 = 0;
  double young_modulus_pa = 0;
  double poisson_ratio = 0;
};

/// The last is "other": any grain.
std::span<const GrainKind> grain_kinds();
std::span<const PlateKind> plate_kinds();

}  // namespace repose::calibrate
