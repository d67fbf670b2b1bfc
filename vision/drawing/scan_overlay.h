#pragma once

#include <string>

#include "vision/picture/picture.h"
#include "vision/scan/scanned_heap.h"

namespace repose::vision {

/// What was measured in a scan, for checking: the heap from above with its heights, contour lines
/// every tenth of the height, its base and axis, and unscanned parts; the angle over the azimuth
/// with the mean and its interval; the mean profile with the line fitted over the window; below,
/// the numbers, and every warning or the reason for a refusal.
Picture draw_scan_overlay(const ScannedHeap& heap, const std::string& title);

}  // namespace repose::vision
