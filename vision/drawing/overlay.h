#pragma once

#include <string>
#include <vector>

#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

namespace repose::vision {

/// What the picture and its result themselves do not contain.
struct OverlayNotes {
  std::string title;          ///< the picture's name
  std::vector<Box> excluded;  ///< MeasureOptions::excluded
  Hints hints = {};           ///< MeasureOptions::hints: the box around the heap, and places
};

/// The picture with everything that was measured drawn into it, for checking and for publications:
/// silhouette, ground line, fitted lines over their window, angles; below, a caption with the mean
/// angle, its interval, the method, and every warning or the reason for a refusal.
///
/// Small pictures are enlarged and large ones reduced, so that lines and letters match.
Picture draw_overlay(const Picture& picture, const ReposeAngle& measured,
                     const OverlayNotes& notes = {});

/// Position of the picture, at the top of its overlay, as fractions of the overlay's width and
/// height.
struct OverlaidArea {
  double left = 0;
  double width = 1;
  double height = 1;
};
OverlaidArea area_in_overlay(const Picture& picture, const Picture& overlay);

}  // namespace repose::vision
