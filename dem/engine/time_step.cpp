#include "dem/engine/time_step.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/engine/audit.h"

namespace repose::dem {
namespace {

/// Deepest overlap of a Hertz contact of two masses: (15 m* v^2 / (16 E* sqrt(R*)))^(2/5).
double impact_overlap(double reduced_mass, double reduced_young, double reduced_radius,
                      double speed) {
  return std::pow(
      15 * reduced_mass * speed * speed / (16 * reduced_young * std::sqrt(reduced_radius)), .4);
}

/// Stiffness over mass, 1/s^2, of a grain pressed onto a flat wall along `down` by `overlap`: all
/// of its spheres that reach the wall act at once.
Matrix6 stiffness_on_wall(const ClumpShape& shape, double mass, const ContactLaw& law,
                          const Vector& down, double overlap) {
  double lowest = 0;
  for (const ClumpSphere& sphere : shape.spheres) {
    lowest = std::max(lowest, down.dot(sphere.centre) + sphere.radius);
  }
  // Effective mass of a point at `arm` along n: 1/m_eff = 1/m + (arm x n) I^-1 (arm x n). The sum
  // of stiffness over mass of all contacts and directions is the trace, no less than any
  // eigenvalue.
  Matrix6 sum = Matrix6::Zero();
  const Vector roots = (mass * shape.gyration_m2).cwiseSqrt().cwiseInverse();
  for (const ClumpSphere& sphere : shape.spheres) {
    const double depth = overlap - (lowest - down.dot(sphere.centre) - sphere.radius);
    if (depth <= 0) continue;
    const double radius = std::sqrt(sphere.radius * depth);
    const double normal = 2 * law.reduced_young_pa * radius;
    const double across = 8 * law.reduced_shear_pa * radius;
    const Vector arm = sphere.centre + down * sphere.radius;
    for (int axis = 0; axis < 3; ++axis) {
      // Three directions that span space: the stiffness is isotropic across `down`.
      const Vector unit = Vector::Unit(axis);
      Eigen::Matrix<double, 6, 1> motion;
      motion << unit / std::sqrt(mass), arm.cross(unit).cwiseProduct(roots);
      sum += across * motion * motion.transpose();
    }
    Eigen::Matrix<double, 6, 1> motion;
    motion << down / std::sqrt(mass), arm.cross(down).cwiseProduct(roots);
    sum += (normal - across) * motion * motion.transpose();
  }
  return sum;
}

/// Directions spread evenly over the sphere (Fibonacci lattice), and the axes.
std::vector<Vector> directions() {
  std::vector<Vector> all = {Vector::UnitX(),  Vector::UnitY(),  Vector::UnitZ(),
                             -Vector::UnitX(), -Vector::UnitY(), -Vector::UnitZ()};
  constexpr int kCount = 200;
  for (int k = 0; k < kCount; ++k) {
    const double z = 1 - (2 * k + 1.0) / kCount;
    const double turn = 2.399963229728653 * k;  // the golden angle
    const double r = std::sqrt(1 - z * z);
    all.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return all;
}

}  // namespace

double accurate_timestep_s(const SimulationSetup& setup, double speed_m_s, double fraction) {
  static const std::vector<Vector> downs = directions();
  Matrices ways(downs.size());
  double greatest = 0;  // of a squared frequency
  for (const GrainKind& kind : setup.kinds) {
    const double mass = kind.shape.volume_m3 * setup.contacts.material(kind.material).density_kg_m3;
    double largest = 0;
    for (const ClumpSphere& sphere : kind.shape.spheres) {
      largest = std::max(largest, sphere.radius);
    }
    for (int other = 0; other < setup.contacts.size(); ++other) {
      const ContactLaw& law = setup.contacts.law(kind.material, other);
      const double overlap = impact_overlap(mass, law.reduced_young_pa, largest, speed_m_s);
      std::ranges::transform(downs, ways.begin(), [&](const Vector& down) {
        return stiffness_on_wall(kind.shape, mass, law, down, overlap);
      });
      greatest = std::max(greatest, greatest_eigenvalue(ways));
    }
  }
  return fraction * 2 / std::sqrt(greatest);
}

void check_timestep(double timestep_s, const SimulationSetup& setup, double speed_m_s,
                    double fraction) {
  const double longest = accurate_timestep_s(setup, speed_m_s, fraction);
  constexpr double kLongestDetour = 1000;
  if (timestep_s < longest / kLongestDetour) {
    throw base::InputError(
        {.subject = "timestep_s",
         .value = fmt::format("is {:.3g}", timestep_s),
         .rule = fmt::format("at least {:.3g} s, a thousandth of the longest accurate step; "
                             "shorter ones take for ever and gain nothing",
                             longest / kLongestDetour),
         .fix = fmt::format("{:.2g}, or leave it to the program.", longest)});
  }
  if (timestep_s <= longest) return;
  throw base::InputError(
      {.subject = "timestep_s",
       .value = fmt::format("is {:.3g}", timestep_s),
       .rule =
           fmt::format("at most {:.3g} s for these grains at {:.2g} m/s; longer ones make energy",
                       longest, speed_m_s),
       .fix = fmt::format("{:.2g}, or leave it to the program.", longest)});
}

}  // namespace repose::dem
