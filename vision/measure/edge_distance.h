#pragma once

#include "vision/measure/reading.h"

namespace repose::vision {

/// Root mean square distance of another reading's edge from the fitted flanks of one, both on the
/// same ground line, as a part of the one's height.
double edge_distance(const Reading& one, const Reading& other);

}  // namespace repose::vision
