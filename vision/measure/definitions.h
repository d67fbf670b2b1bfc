#pragma once

#include <vector>

#include "vision/measure/reading.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {

/// The same heap's angle by other definitions in use; those that the picture allows.
std::vector<NamedAngle> other_definitions(const Reading& reading);

}  // namespace repose::vision
