#pragma once

#include <string>

#include "calibrate/export/export.h"
#include "dem/contact/material.h"
#include "dem/shape/clump/clump_shape.h"

namespace repose::calibrate {

enum class Partner { wall, grain };

/// Distance from a clump's centre of mass to its contact with a flat partner, divided by the radius
/// of the touching sphere.
struct ArmRatio {
  double mean = 1;
  double low = 1;
  double high = 1;
};

/// Over equally likely poses: on a wall, where grains roll lying, those with the axis of the
/// smallest moment of inertia level; against other grains, all orientations. Proved by ArmRatio.*
/// in tests/calibrate/export_rolling_test.cpp.
ArmRatio arm_ratio(const dem::ClumpShape& grain, Partner partner);

/// How the rolling friction of a pair is converted.
struct RollingConversion {
  double factor = 1;  ///< theirs / ours
  Fidelity fidelity = Fidelity::exact;
  std::string limits = {};
};

/// Our models: dem/THEORY.md, "Rolling resistance". Theirs: TargetEntry::rolling_law. With F the
/// normal force, R the radius of the touching sphere, r the distance from the centre of mass to the
/// contact and R* = R1 R2 / (R1 + R2), the coefficients are chosen such that the torques while
/// rolling are equal.
RollingConversion convert_rolling(ExportTarget target, dem::RollingModel model, Partner partner,
                                  const dem::ClumpShape& grain);

/// Our definition, as a sentence.
std::string rolling_law(dem::RollingModel model);

/// Converts to a torque against the relative spin whose lever is R on a wall, and `grain_lever`
/// times R* = R / 2 between two equal spheres.
RollingConversion to_relative_spin(dem::RollingModel model, Partner partner,
                                   const dem::ClumpShape& grain, double grain_lever);

/// Adds the differences that arise if their torque comes from a spring of fixed stiffness.
void limit_to_fixed_spring(RollingConversion& converted);

/// Whether all spheres of the clump have the same radius.
bool has_equal_radii(const dem::ClumpShape& grain);

}  // namespace repose::calibrate
