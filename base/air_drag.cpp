#include "base/air_drag.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace repose::base {
namespace {

constexpr double kAir_kg_m3 = 1.204;  // dry, 20 C, 1013.25 hPa
constexpr double kAirViscosity_pa_s = 1.82e-5;
constexpr double kSphere = .999;  // a grain of at least this sphericity counts as a sphere

double sphere_drag_coefficient(double reynolds) {
  constexpr double kNewton = .44, kFromReynolds = 1000;
  if (reynolds > kFromReynolds) return kNewton;
  return 24 / reynolds * (1 + .15 * std::pow(reynolds, .687));
}

double haider_levenspiel(double reynolds, double phi) {
  const double a = std::exp(2.3288 - 6.4581 * phi + 2.4486 * phi * phi);
  const double b = .0964 + .5565 * phi;
  const double c =
      std::exp(4.905 - 13.8944 * phi + 18.4222 * phi * phi - 10.2599 * phi * phi * phi);
  const double d =
      std::exp(1.4681 + 12.2584 * phi - 20.7322 * phi * phi + 15.8855 * phi * phi * phi);
  return 24 / reynolds * (1 + a * std::pow(reynolds, b)) + c / (1 + d / reynolds);
}

/// d(v^2)/dz / 2 on the way down (`along` 1) or up (-1), with z measured from the highest point,
/// m/s2.
double acceleration_m_s2(const FallingGrain& grain, double speed2, double along) {
  const double own_m_s2 = kStandardGravity_m_s2 * (1 - kAir_kg_m3 / grain.density_kg_m3);
  const double speed = std::sqrt(std::max(0., speed2));
  if (speed == 0) return own_m_s2;
  const double reynolds = kAir_kg_m3 * speed * grain.diameter_m / kAirViscosity_pa_s;
  // C_d (pi/4 d^2) (rho_air/2 v^2) divided by the mass pi/6 d^3 rho_grain.
  const double drag_m_s2 = .75 * drag_coefficient(reynolds, grain.sphericity) * kAir_kg_m3 *
                           speed2 / (grain.density_kg_m3 * grain.diameter_m);
  return own_m_s2 - along * drag_m_s2;
}

/// At which drag equals the buoyant weight; found by bisection.
double terminal_speed_m_s(const FallingGrain& grain) {
  double low = 0;
  double high = 1e3;
  constexpr int kHalvings = 60;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = .5 * (low + high);
    (acceleration_m_s2(grain, middle * middle, 1) > 0 ? low : high) = middle;
  }
  return .5 * (low + high);
}

/// Fourth-order Runge-Kutta for v^2 over the height.
double speed_m_s(const FallingGrain& grain, double height_m, double along) {
  constexpr int kSteps = 400;
  const double step_m = height_m / kSteps;
  const auto slope = [&](double speed2) { return 2 * acceleration_m_s2(grain, speed2, along); };
  double speed2 = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double a = slope(speed2);
    const double b = slope(speed2 + .5 * step_m * a);
    const double c = slope(speed2 + .5 * step_m * b);
    const double d = slope(speed2 + step_m * c);
    speed2 += step_m / 6 * (a + 2 * b + 2 * c + d);
  }
  return std::sqrt(std::max(0., speed2));
}

}  // namespace

double drag_coefficient(double reynolds, double sphericity) {
  const double sphere = sphere_drag_coefficient(reynolds);
  if (sphericity >= kSphere) return sphere;
  return sphere * haider_levenspiel(reynolds, sphericity) / haider_levenspiel(reynolds, 1);
}

double drag_uncertainty(const FallingGrain& grain) {
  constexpr double kOfSpheres = .07, kOfOthers = .2;
  return grain.sphericity >= kSphere ? kOfSpheres : kOfOthers;
}

double speed_after_fall_m_s(const FallingGrain& grain, double fall_m) {
  // After a fall of this many times v^2 / g the speed no longer changes.
  constexpr double kLongFall = 40;
  const double terminal_m_s = terminal_speed_m_s(grain);
  return speed_m_s(
      grain, std::min(fall_m, kLongFall * terminal_m_s * terminal_m_s / kStandardGravity_m_s2), 1);
}

double speed_before_rise_m_s(const FallingGrain& grain, double rise_m) {
  return speed_m_s(grain, rise_m, -1);
}

double rise_without_air_m(const FallingGrain& grain, double fall_m, double rise_m) {
  const double ratio = speed_before_rise_m_s(grain, rise_m) / speed_after_fall_m_s(grain, fall_m);
  return ratio * ratio * fall_m;
}

}  // namespace repose::base
