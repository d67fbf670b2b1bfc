#pragma once

#include <cstdint>

#include "vision/measure/body.h"
#include "vision/measure/segmentation.h"
#include "vision/measure/working_picture.h"

/// Second pass: segmentations that start from a body already found.
namespace repose::vision {

/// Learns the colours and texture on both sides of the body's edge and separates them again:
/// Fisher's linear discriminant on L*, a*, b*, roughness and the position along the ground, so that
/// the threshold follows a gradient in lighting across the picture.
Segmentation learned_segmentation(const WorkingPicture& work, const Body& body);

/// GrabCut around the body at low resolution; repeatable for a given seed. Coarse: pass its result
/// to learned_segmentation().
Segmentation grabcut_segmentation(const WorkingPicture& work, const Body& body, std::uint64_t seed);

/// Heap and backdrop by GrabCut from the user's hints: places on the heap and beside it, and a box
/// around it, which a heap fills like a triangle standing on the box's lower side. Same seed, same
/// result.
Segmentation seeded_segmentation(const WorkingPicture& work, std::uint64_t seed);

}  // namespace repose::vision
