#pragma once

#include <functional>

#include "vision/camera/heap_sizes.h"
#include "vision/camera/heap_view.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {

/// Sizes through a known lens.
///
/// The heap is round: its feet are where vertical planes through the eye touch the base circle,
///
///     R = D sin((a_r - a_l) / 2)
///
///     R          mm    radius of the base
///     D          mm    distance of the axis from the eye, along the ground: where the middle of
///                      the two directions meets the view's plane
///     a_l, a_r   rad   directions of the feet, seen from above
///
/// and its height follows from the slopes of the lines of sight to the crest and the ground:
///
///     h = D tan(b_c) - (D - q R) tan(b_g)
///
///     b_c, b_g   rad   of the crest and of the ground line below it, above the eye's level
///     q          -     where the ground line touches the base: 0 below the axis, 1 at the rim
///                      nearest to the camera, which is lower in the picture
///
/// q is estimated from how high the outline's ends, which lie beside the axis, are above the ground
/// line, and from where segmentations usually end, which is near the rim. Proved by
/// tests/vision/sized_heap_test.cpp on projected cones.
/// @param inputs, view_of  the view's inputs, and the function that makes the view of them
/// @param scale_part  half-width of the scale's own error, as a fraction of it
HeapSizes sizes_by_view(const ReposeAngle& measured, const Inputs& inputs,
                        const std::function<HeapView(const Eigen::VectorXd&)>& view_of,
                        double scale_part, double working_px);

/// Sizes from a scale alone, for a camera of unknown distance and focal length: assumed at least
/// six base radii away, at the height implied by the base's bow; the uncertainty allows for both.
HeapSizes sizes_by_scale(const ReposeAngle& measured, const Estimate& mm_per_px, double working_px);

/// Side of a pixel of the working picture, in pixels of the picture.
double working_pixel(int width, int height, const Hints& hints);

}  // namespace repose::vision
