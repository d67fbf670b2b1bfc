#pragma once

#include "dem/experiment/course.h"

namespace repose::dem {

/// Grains of a heap that are to come to rest, from now on.
void begin_settling(Course& course, HeapStage stage);

/// Waits for it, telling `share`; false when they still moved (creep) after 5 s.
bool settle(Course& course, double share);

}  // namespace repose::dem
