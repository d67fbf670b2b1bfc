#include "calibrate/statistics/bench/formulas.h"

#include <algorithm>
#include <cmath>

namespace repose::calibrate {

double restitution_of(double drop_m, double rebound_m) { return std::sqrt(rebound_m / drop_m); }

double sliding_friction_of(double angle_rad) { return std::tan(angle_rad); }

double rolling_friction_of(double incline_rad, double released_m, double stopped_m) {
  return released_m * std::sin(incline_rad) / (released_m * std::cos(incline_rad) + stopped_m);
}

double foot_distance_m(double incline_rad, double radius_m) {
  return radius_m * std::tan(incline_rad / 2);
}

double rolled_distance_m(double mu_r, double incline_rad, double released_m, double radius_m) {
  const double sine = std::sin(incline_rad);
  const double cosine = std::cos(incline_rad);
  const double foot_m = foot_distance_m(incline_rad, radius_m);
  const double kept = std::max(0., (5 * cosine + 2) / 7 - 5. / 7 * mu_r * sine);
  return kept * kept * (released_m - foot_m) * (sine - mu_r * cosine) / mu_r + foot_m;
}

double rolling_friction_of(double incline_rad, double released_m, double stopped_m,
                           double radius_m) {
  // The distance falls with the friction as long as the ball leaves the foot. By halving.
  double low = 0;
  double high =
      std::min(std::tan(incline_rad), (std::cos(incline_rad) + .4) / std::sin(incline_rad));
  constexpr int kHalvings = 60;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = .5 * (low + high);
    const bool rolls_on = rolled_distance_m(middle, incline_rad, released_m, radius_m) > stopped_m;
    (rolls_on ? low : high) = middle;
  }
  return .5 * (low + high);
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
