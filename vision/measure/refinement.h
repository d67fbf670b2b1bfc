#pragma once

#include <cstdint>

#include "vision/measure/body.h"
#include "vision/measure/segmentation.h"
#include "vision/measure/working_picture.h"

/// Second looks: segmentations that start from a body already found.
namespace repose::vision {

/// Learns the colours and texture on both sides of the body's edge and separates them anew:
/// Fisher's linear discriminant on L*, a*, b*, roughness and the position along the ground, so that
/// light falling off across the picture moves the threshold with it.
Segmentation learned_segmentation(const WorkingPicture& work, const Body& body);

/// GrabCut around the body at low resolution; repeatable for a seed. Coarse: learn from its result.
Segmentation grabcut_segmentation(const WorkingPicture& work, const Body& body, std::uint64_t seed);

/// Heap and backdrop by GrabCut from what a person has said: places on the heap and beside it, and
/// a box around it, which a heap fills like a triangle on the box's lower side. Same seed, same
/// result.
Segmentation seeded_segmentation(const WorkingPicture& work, std::uint64_t seed);

}  // namespace repose::vision
