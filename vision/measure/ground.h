#pragma once

#include <optional>
#include <vector>

#include "vision/measure/geometry.h"
#include "vision/measure/ground_line.h"
#include "vision/measure/regions.h"
#include "vision/measure/working_picture.h"

namespace repose::vision {

/// The line a heap stands on, and what gave it away.
struct Ground : PictureLine {
  double deviation_rad = 0;        ///< standard uncertainty of its tilt
  std::optional<double> bow = {};  ///< how far the base bows downwards, as a fraction of its width;
                                   ///< empty when the base is not seen
  bool mirrored = false;           ///< it is the axis of a reflection
  bool behind = false;             ///< the heap goes on below it: an edge behind the heap
  bool before = false;             ///< the heap ends above it: an edge before the heap
};

/// Bow of a base that is seen from its own level.
inline constexpr double kFlatBase = 0.006;

/// Finds the ground below one region: bare ground beside the heap when the region holds the ground,
/// too; else the region's own base; else the axis of a reflection; else the line through the two
/// ends of a base that bows. Empty when none of these is near level.
std::optional<Ground> find_ground(const Spans& region, const WorkingPicture& work);

/// The ground that the picture itself shows best along the base, of all that segmentations have
/// found there: one that sees the flanks sharply may still bleed into the plate. Where that is an
/// edge behind the heap it is the best of those that are its foot. Where none of them
/// lies on a plain edge, the edge is searched for nearby. What equally good lines disagree about,
/// and half of what the search changes, is added to the tilt's uncertainty. Needs a candidate.
Ground best_ground(const std::vector<Ground>& candidates, const Base& base,
                   const WorkingPicture& work);

}  // namespace repose::vision
