#include "calibrate/export/rolling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "calibrate/export/target_entry.h"
#include "dem/experiment/model_setup.h"

namespace repose::calibrate {
namespace {

constexpr int kDirections = 4000;

/// Distance to where a plane normal to `direction` touches the clump, divided by the radius of the
/// touched sphere.
double arm_ratio_along(const dem::ClumpShape& grain, const dem::Vector& direction) {
  const auto reach = [&](const dem::ClumpSphere& sphere) {
    return direction.dot(sphere.centre) + sphere.radius;
  };
  const auto touching = std::max_element(
      grain.spheres.begin(), grain.spheres.end(),
      [&](const auto& one, const auto& other) { return reach(one) < reach(other); });
  return (touching->centre + touching->radius * direction).norm() / touching->radius;
}

/// The k-th of kDirections spread evenly over all directions.
dem::Vector any_direction(int k) {
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0)) * k;
  const double z = 1 - (2 * k + 1.0) / kDirections;
  const double across = std::sqrt(1 - z * z);
  return {across * std::cos(turn), across * std::sin(turn), z};
}

/// The k-th of kDirections normal to the long axis.
dem::Vector lying_direction(const dem::ClumpShape& grain, int k) {
  const double turn = 2 * std::numbers::pi * k / kDirections;
  const dem::Quaternion lying = dem::lying_pose(grain);  // the long axis along y
  return lying.conjugate() * dem::Vector(std::cos(turn), 0, std::sin(turn));
}

bool is_centred_sphere(const dem::ClumpShape& grain) {
  return grain.spheres.size() == 1 &&
         grain.spheres.front().centre.norm() < 1e-6 * grain.spheres.front().radius;
}

/// Converts from `constant_torque`, mu_r F r against each body's own spin, to a lever of R or R*.
RollingConversion from_own_spin(Partner partner, const dem::ClumpShape& grain, double lever) {
  const ArmRatio arm = arm_ratio(grain, partner);
  const double in_reduced_radii = partner == Partner::wall ? 1 : 2;
  RollingConversion converted{.factor = arm.mean * in_reduced_radii / lever};
  if (!is_centred_sphere(grain)) {
    converted.fidelity = Fidelity::approximate;
    converted.limits = fmt::format(
        "Our torque has the grain's own lever, theirs that of the sphere that touches: {:.3g} "
        "times as long in the mean over {} poses, {:.3g} to {:.3g} in single ones. ",
        arm.mean, partner == Partner::wall ? "lying" : "all", arm.low, arm.high);
  }
  if (partner == Partner::grain) {
    converted.fidelity = Fidelity::approximate;
    converted.limits +=
        "Ours acts against each grain's own spin, theirs against the relative spin: the same when "
        "the two spins are equal and opposite. A grain at rest is turned by its neighbour in "
        "theirs only, and two that spin alike are braked in ours only. ";
  }
  return converted;
}

}  // namespace

ArmRatio arm_ratio(const dem::ClumpShape& grain, Partner partner) {
  ArmRatio ratio{.mean = 0, .low = HUGE_VAL, .high = 0};
  for (int k = 0; k < kDirections; ++k) {
    const dem::Vector direction =
        partner == Partner::wall ? lying_direction(grain, k) : any_direction(k);
    const double own = arm_ratio_along(grain, direction);
    ratio.mean += own / kDirections;
    ratio.low = std::min(ratio.low, own);
    ratio.high = std::max(ratio.high, own);
  }
  return ratio;
}

RollingConversion convert_rolling(ExportTarget target, dem::RollingModel model, Partner partner,
                                  const dem::ClumpShape& grain) {
  if (model == dem::RollingModel::none) return {};
  RollingConversion converted = target->rolling(model, partner, grain);
  if (!converted.limits.empty()) converted.limits.pop_back();
  return converted;
}

RollingConversion to_relative_spin(dem::RollingModel model, Partner partner,
                                   const dem::ClumpShape& grain, double grain_lever) {
  const double lever = partner == Partner::grain ? grain_lever : 1;
  if (model == dem::RollingModel::constant_torque) return from_own_spin(partner, grain, lever);
  return {.factor = 1 / lever, .fidelity = Fidelity::exact, .limits = {}};
}

void limit_to_fixed_spring(RollingConversion& converted) {
  converted.fidelity = std::max(converted.fidelity, Fidelity::close);
  converted.limits +=
      "Their torque comes from a spring that yields at the limit: the same while the grain rolls "
      "one way. Its stiffness is fixed, that of our elastic-plastic spring on a wall under the "
      "grain's own weight. ";
}

bool has_equal_radii(const dem::ClumpShape& grain) {
  return std::all_of(grain.spheres.begin(), grain.spheres.end(), [&](const auto& sphere) {
    return std::abs(sphere.radius - grain.spheres.front().radius) < 1e-9 * sphere.radius;
  });
}

std::string rolling_law(dem::RollingModel model) {
  switch (model) {
    case dem::RollingModel::none:
      return "no rolling friction";
    case dem::RollingModel::constant_torque:
      return "torque on each body mu_r F times its own distance from centre of mass to contact, "
             "against its own spin";
    case dem::RollingModel::relative_constant_torque:
      return "torque mu_r F R* on both bodies, against their relative spin";
    case dem::RollingModel::elastic_plastic:
      break;
  }
  return "torque of a rolling spring up to mu_r F R* on both bodies, against their relative "
         "rotation";
}

}  // namespace repose::calibrate
