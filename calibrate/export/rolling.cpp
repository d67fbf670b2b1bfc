#include "calibrate/export/rolling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "dem/experiment/model_setup.h"

namespace repose::calibrate {
namespace {

constexpr int kDirections = 4000;

/// Where a plane across `direction` touches the clump, per radius of the sphere that it touches.
double arm_ratio_along(const dem::ClumpShape& grain, const dem::Vector& direction) {
  const auto reach = [&](const dem::ClumpSphere& sphere) {
    return direction.dot(sphere.centre) + sphere.radius;
  };
  const auto touching = std::max_element(
      grain.spheres.begin(), grain.spheres.end(),
      [&](const auto& one, const auto& other) { return reach(one) < reach(other); });
  return (touching->centre + touching->radius * direction).norm() / touching->radius;
}

/// The k-th of kDirections that are spread evenly over all.
dem::Vector any_direction(int k) {
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0)) * k;
  const double z = 1 - (2 * k + 1.0) / kDirections;
  const double across = std::sqrt(1 - z * z);
  return {across * std::cos(turn), across * std::sin(turn), z};
}

/// The k-th of those across the long axis.
dem::Vector lying_direction(const dem::ClumpShape& grain, int k) {
  const double turn = 2 * std::numbers::pi * k / kDirections;
  const dem::Quaternion lying = dem::lying_pose(grain);  // the long axis along y
  return lying.conjugate() * dem::Vector(std::cos(turn), 0, std::sin(turn));
}

bool has_equal_radii(const dem::ClumpShape& grain) {
  return std::all_of(grain.spheres.begin(), grain.spheres.end(), [&](const auto& sphere) {
    return std::abs(sphere.radius - grain.spheres.front().radius) < 1e-9 * sphere.radius;
  });
}

/// The lever that a target multiplies its coefficient and the normal force with: of a wall in R, of
/// two equal spheres in R* = R / 2.
double lever(ExportTarget target, Partner partner) {
  const bool is_mean_of_radii = target == ExportTarget::yade;
  return is_mean_of_radii && partner == Partner::grain ? 2 : 1;
}

bool is_centred_sphere(const dem::ClumpShape& grain) {
  return grain.spheres.size() == 1 &&
         grain.spheres.front().centre.norm() < 1e-6 * grain.spheres.front().radius;
}

/// From `constant_torque`, mu_r F r against each body's own spin, to a lever of R or R*.
RollingConversion from_own_spin(ExportTarget target, Partner partner,
                                const dem::ClumpShape& grain) {
  const ArmRatio arm = arm_ratio(grain, partner);
  const double in_reduced_radii = partner == Partner::wall ? 1 : 2;
  RollingConversion converted{.factor = arm.mean * in_reduced_radii / lever(target, partner)};
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

/// EDEM has all three laws, with the same levers: Standard, RVD and Type C rolling friction
/// (Altair, EDEM 2023 documentation, "Rolling Friction").
RollingConversion to_edem(dem::RollingModel model, Partner partner) {
  RollingConversion converted;
  if (model == dem::RollingModel::constant_torque) return converted;
  if (model == dem::RollingModel::elastic_plastic) {
    converted.fidelity = Fidelity::close;
    converted.limits =
        "The same limit and the same damping ratio; the spring up to there has EDEM's own normal "
        "stiffness in it, which grows with the overlap otherwise than ours. ";
  } else if (partner == Partner::grain) {
    converted.fidelity = Fidelity::close;
    converted.limits =
        "Between two grains EDEM's manual prints the direction as that of half the sum of both "
        "spins, which is nought where two equal grains roll off each other. We take it for the "
        "relative spin, as in the model of Ai et al. (type A) that the manual says it is: simulate "
        "roll_on_grains there before you trust it. ";
  }
  return converted;
}

bool has_rolling_spring(ExportTarget target) {
  return target == ExportTarget::lammps || target == ExportTarget::yade;
}

/// Against the relative spin here and there: levers may differ.
RollingConversion from_relative_spin(ExportTarget target, Partner partner,
                                     const dem::ClumpShape& grain) {
  RollingConversion converted{.factor = 1 / lever(target, partner)};
  if (target == ExportTarget::yade && partner == Partner::grain && !has_equal_radii(grain)) {
    converted.fidelity = Fidelity::approximate;
    converted.limits =
        "Their lever is the mean of both radii, ours R*: the factor is that of equal radii, and "
        "the grain's spheres differ. ";
  }
  return converted;
}

void add_spring_limits(ExportTarget target, dem::RollingModel model, RollingConversion& converted) {
  if (has_rolling_spring(target)) {
    converted.fidelity = std::max(converted.fidelity, Fidelity::close);
    converted.limits +=
        "Their torque comes from a spring that yields at the limit: the same while the grain rolls "
        "one way. Its stiffness is fixed, that of our elastic-plastic spring on a wall under the "
        "grain's own weight. ";
  } else if (model == dem::RollingModel::relative_constant_torque &&
             target == ExportTarget::liggghts) {
    converted.limits +=
        "Theirs trembles about rest, and lets what it should hold creep, the slower the shorter "
        "the time step; ours holds it. ";
  } else if (model == dem::RollingModel::constant_torque && target == ExportTarget::liggghts) {
    converted.limits +=
        "Theirs leaves out spin about the contact's normal, and trembles about rest where ours "
        "stops dead. ";
  }
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
  RollingConversion converted;
  if (model == dem::RollingModel::none) return converted;
  if (target == ExportTarget::edem) {
    converted = to_edem(model, partner);
  } else if (model == dem::RollingModel::constant_torque) {
    converted = from_own_spin(target, partner, grain);
  } else {
    converted = from_relative_spin(target, partner, grain);
  }
  add_spring_limits(target, model, converted);
  if (!converted.limits.empty()) converted.limits.pop_back();
  return converted;
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

std::string rolling_law(ExportTarget target, dem::RollingModel model) {
  switch (target) {
    case ExportTarget::liggghts:
      if (model == dem::RollingModel::none) return "no rolling model";
      return model == dem::RollingModel::elastic_plastic
                 ? "epsd: rolling spring, up to mu_r F R*, against the relative rotation"
                 : "cdt: mu_r F R* against the relative spin, F without the damper's part";
    case ExportTarget::lammps:
      return "rolling sds: spring, up to mu_r F R*, against the relative rotation, F without the "
             "damper's part";
    case ExportTarget::yade:
      return "includeMoment: bending spring krot, up to eta F (R1 + R2) / 2, against the relative "
             "rotation; a wall counts with the sphere's radius";
    case ExportTarget::edem:
      break;
  }
  if (model == dem::RollingModel::relative_constant_torque) {
    return "RVD rolling friction: mu_r F R* on both bodies, against their relative spin";
  }
  if (model == dem::RollingModel::elastic_plastic) {
    return "Type C rolling friction: spring, up to mu_r F R*, and damper, against the relative "
           "rotation";
  }
  return "standard rolling friction: mu_r F times each body's own distance from centre of mass to "
         "contact, against its own spin";
}

}  // namespace repose::calibrate
