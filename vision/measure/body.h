#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/measure/ground.h"
#include "vision/measure/segmentation.h"
#include "vision/measure/working_picture.h"

namespace repose::vision {

/// A solid region of the working picture that may be the heap, and the line it stands on.
struct Body {
  cv::Mat1b mask;  ///< 255 inside; nothing below the ground line
  Ground ground;
};

/// Fills holes and cuts off the ground, for each of the few largest regions; largest first.
std::vector<Body> find_bodies(const Segmentation& segmentation, const WorkingPicture& work);

/// The largest region, unchanged except that holes are filled, on a level line through its lowest
/// pixel.
Body largest_region(const Segmentation& segmentation, const WorkingPicture& work);

/// The same heap by another segmentation, on the ground line already known. Empty mask if nothing
/// stands there.
Body body_on(const Body& known, const Segmentation& segmentation, const WorkingPicture& work);

/// Small pieces with their feet on the ground, apart from the heap itself.
int count_strays(const Body& body, const Segmentation& segmentation, const WorkingPicture& work);

}  // namespace repose::vision
