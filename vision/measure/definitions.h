#pragma once

#include <optional>
#include <vector>

#include "vision/measure/reading.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {

/// An edge whose flanks were fitted.
struct FittedEdge {
  const Profile& profile;
  const FlankFit& left;
  const FlankFit& right;
  std::optional<double> grain;  ///< in the profile's unit; none: read off the edge's bumps
};

/// The same heap's angle by the other definitions of base/angle_definition.h, of the sides that
/// exist; those that the edge allows.
std::vector<NamedAngle> other_definitions(const FittedEdge& edge);
std::vector<NamedAngle> other_definitions(const Reading& reading);

}  // namespace repose::vision
