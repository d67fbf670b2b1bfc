#include "calibrate/statistics/bench/formulas.h"

#include <cmath>

namespace repose::calibrate {

double restitution_of(double drop_m, double rebound_m) { return std::sqrt(rebound_m / drop_m); }

double sliding_friction_of(double angle_rad) { return std::tan(angle_rad); }

double rolling_friction_of(double incline_rad, double released_m, double stopped_m) {
  return released_m * std::sin(incline_rad) / (released_m * std::cos(incline_rad) + stopped_m);
}

double pendulum_restitution_of(double release_rad, double swing_rad) {
  return 2 * std::sin(swing_rad / 2) / std::sin(release_rad / 2) - 1;
}

double density_of(double mass_kg, double displaced_m3) { return mass_kg / displaced_m3; }

double young_modulus_of(double force_n, double area_m2, double compression_m, double height_m) {
  return (force_n / area_m2) / (compression_m / height_m);
}

double poisson_ratio_of(double widening, double width, double shortening, double height) {
  return (widening / width) / (shortening / height);
}

double geometric_mean_diameter_of(double length, double width, double thickness) {
  return std::cbrt(length * width * thickness);
}

double sphericity_of(double length, double width, double thickness) {
  return geometric_mean_diameter_of(length, width, thickness) / length;
}

}  // namespace repose::calibrate
