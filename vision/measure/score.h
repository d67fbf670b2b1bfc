#pragma once

#include "vision/measure/reading.h"
#include "vision/measure/working_picture.h"

namespace repose::vision {

/// Fills in the reading's edge contrast, edge sharpness and score from the picture beside the edge.
void score(Reading& reading, const WorkingPicture& work);

}  // namespace repose::vision
