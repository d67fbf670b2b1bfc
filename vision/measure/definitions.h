#pragma once

#include <optional>
#include <vector>

#include "base/angle_definition.h"
#include "vision/measure/flank.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {

/// An edge whose flanks were fitted.
struct FittedEdge {
  const Profile& profile;
  const FlankFit& left;
  const FlankFit& right;
  std::optional<double> grain;  ///< in the profile's unit; std::nullopt: from the edge's bumps
};

/// A heap's flanks as measured by a definition of base/angle_definition.h.
struct DefinedFlanks {
  const base::AngleDefinition* definition = nullptr;
  FlankFit left;
  FlankFit right;

  const FlankFit& flank(Side side) const { return side == Side::left ? left : right; }
  double angle_rad() const { return mean_angle_rad(left, right); }
};

/// The same heap's flanks by the definitions other than the default: for the sides that were
/// fitted, and only definitions valid for all of those sides. Naming a definition fixes the window,
/// so the effect of other windows is no part of these fits' errors. The error of height over base
/// assumes that the crest and the foot may each be off by up to a grain's radius, uniformly: JCGM
/// 100:2008 (GUM), 4.3.7 and 5.1.2,
///
///     u = d / sqrt(12) cos(a) / r      u  standard error of the angle a [rad]
///                                      d  grain, r  from below the crest to the foot, same unit
///
/// Proved by OtherDefinitions.* in tests/vision/definitions_test.cpp.
std::vector<DefinedFlanks> other_flanks(const FittedEdge& edge);

/// Their angles, without intervals.
std::vector<NamedAngle> other_definitions(const FittedEdge& edge);

}  // namespace repose::vision
