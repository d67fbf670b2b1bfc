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
  std::optional<double> grain;  ///< in the profile's unit; none: read off the edge's bumps
};

/// A heap's flanks as a definition of base/angle_definition.h reads them.
struct DefinedFlanks {
  const base::AngleDefinition* definition = nullptr;
  FlankFit left;
  FlankFit right;

  const FlankFit& flank(Side side) const { return side == Side::left ? left : right; }
  double angle_rad() const { return mean_angle_rad(left, right); }
};

/// The same heap's flanks by the definitions other than the usual one: of the sides that the edge
/// was fitted on, and those definitions that all of these allow. Whoever names a definition has
/// chosen the window, so that what another would change is no part of these fits' errors. The
/// error of height over base is that the crest and the foot may each be a grain's radius to either
/// side, evenly: JCGM 100:2008 (GUM), 4.3.7 and 5.1.2,
///
///     u = d / sqrt(12) cos(a) / r      u  standard error of the angle a [rad]
///                                      d  grain, r  from below the crest to the foot, one unit
///
/// Proved by OtherDefinitions.* in tests/vision/definitions_test.cpp.
std::vector<DefinedFlanks> other_flanks(const FittedEdge& edge);

/// The angles of those, without intervals.
std::vector<NamedAngle> other_definitions(const FittedEdge& edge);

}  // namespace repose::vision
