#pragma once

#include "vision/measure/segmentation.h"
#include "vision/measure/working_picture.h"

namespace repose::vision {

inline constexpr const char* kTraced = "traced";  ///< name of the segmentation

/// The edge of the heap between a box and a ground line that a person has drawn: of all edges that
/// rise from the ground to one crest and fall to it again, the one along which the picture differs
/// most on both sides. It needs no colour of a backdrop, of which there may be many. Coarse: learn
/// from its result.
Segmentation traced_segmentation(const WorkingPicture& work);

}  // namespace repose::vision
