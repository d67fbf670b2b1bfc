#pragma once

#include <functional>

#include "vision/camera/heap_sizes.h"
#include "vision/camera/heap_view.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {

/// Sizes through a known lens.
///
/// The heap is round: its feet are where the eye's upright planes touch the base circle,
///
///     R = D sin((a_r - a_l) / 2)
///
///     R          mm    radius of the base
///     D          mm    distance of the axis from the eye, along the ground: where the middle of
///     the
///                      two directions meets the view's plane
///     a_l, a_r   rad   directions of the feet, seen from above
///
/// and its height follows from how far the crest lies above the eye's level and the ground below:
///
///     h = D tan(b_c) - (D - q R) tan(b_g)
///
///     b_c, b_g   rad   of the crest and of the ground line below it, above the eye's level
///     q          -     where the ground line touches the base: 0 below the axis, 1 at the rim that
///                      is nearest to the camera, which lies lower in the picture
///
/// q follows from how high the outline's ends, which lie beside the axis, stand above the ground
/// line; and from where segmentations usually end, which is near the rim. Proved by
/// tests/vision/sized_heap_test.cpp on projected cones.
/// @param inputs, view_of  what the view is made of, and how
/// @param scale_part  half-width of the scale's own error, as a part of it
HeapSizes sizes_by_view(const ReposeAngle& measured, const Inputs& inputs,
                        const std::function<HeapView(const Eigen::VectorXd&)>& view_of,
                        double scale_part, double working_px);

/// Sizes by a scale alone, of a camera whose distance and focal length are not known: as one sees
/// them from at least six base radii away, from as far above as the base's bow says; their
/// uncertainty allows for both.
HeapSizes sizes_by_scale(const ReposeAngle& measured, const Estimate& mm_per_px, double working_px);

/// A pixel of the picture in which a heap is found, in pixels of the picture.
double working_pixel(int width, int height, const Hints& hints);

}  // namespace repose::vision
