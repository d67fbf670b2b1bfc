#pragma once

#include <optional>

#include "vision/measure/geometry.h"
#include "vision/measure/regions.h"
#include "vision/measure/working_picture.h"

namespace repose::vision {

/// The line a heap stands on, and what gave it away.
struct Ground {
  PictureLine line;
  double deviation_rad = 0;  ///< standard uncertainty of its tilt
  double bow = 0;            ///< how far the base bows downwards, as a share of its width
  bool mirrored = false;     ///< it is the axis of a reflection
};

/// Finds the ground below one region: bare ground beside the heap when the region holds the ground,
/// too; else the region's own base; else the axis of a reflection; else the line through the two
/// ends of a base that bows. Empty when none of these is near level.
std::optional<Ground> find_ground(const Spans& region, const WorkingPicture& work);

}  // namespace repose::vision
