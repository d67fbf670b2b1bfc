#pragma once

#include "vision/measure/reading.h"

namespace repose::vision {

/// What tells a heap of grains from other things that stand on the ground and have sloping sides.
struct Likeness {
  double filled = 1;    ///< part of what is under the upper edge that belongs to the body: legs,
                        ///< wheels and branches leave gaps
  double climb = 0;     ///< by how much the smoothed edge rises again on its way down from the
                        ///< crest, of the crest's height; the larger of the two sides
  double straight = 0;  ///< longest straight edge inside the body, of the crest's height
  double patchy = 0;    ///< part of the body where its colour changes within a tenth of the height:
                        ///< a thing of several parts, not one material
};

/// Of a reading that has a flank.
Likeness likeness_of(const Reading& reading, const WorkingPicture& work);

}  // namespace repose::vision
