#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "vision/measure/repose_angle.h"
#include "vision/measure/scale_bar.h"
#include "vision/picture/picture.h"

/// A camera's lens: how directions become places in its pictures.
namespace repose::vision {

/// A number with the half-width of its 95 % interval; 0: taken as exact.
struct LensNumber {
  double value = 0;
  double uncertainty = 0;
};

/// Pinhole camera of square pixels, with the distortion of Brown (1971), Photogrammetric
/// Engineering 37, 855-866, in the form of OpenCV:
///
///     x'' = x' (1 + k1 r^2 + k2 r^4 + k3 r^6) + 2 p1 x' y' + p2 (r^2 + 2 x'^2)
///     y'' = y' (1 + k1 r^2 + k2 r^4 + k3 r^6) + p1 (r^2 + 2 y'^2) + 2 p2 x' y'
///     u = f x'' + cx    v = f y'' + cy
///
///     x', y'   -    right and down, over the distance along the axis; r^2 = x'^2 + y'^2
///     u, v     px   place in the picture (0, 0: outer corner of the top left pixel)
///     f        px   focal_px
///     cx, cy   px   centre_x_px, centre_y_px: where the axis meets the picture
///     k, p     -    radial and tangential distortion
///
/// Proved by tests/vision/lens_test.cpp against the formula, and by what the renderer draws.
struct Lens {
  int width = 0;  ///< of the pictures it holds for [px]
  int height = 0;
  LensNumber focal_px = {};
  LensNumber centre_x_px = {};
  LensNumber centre_y_px = {};
  LensNumber k1 = {}, k2 = {}, p1 = {}, p2 = {}, k3 = {};

  bool is_distorted() const;
  /// Where a point of the picture lies in the corrected picture: the one that a lens with the same
  /// focal length and centre takes, but without distortion. And back.
  Point corrected(Point place) const;
  Point seen(Point place) const;
};

/// The same lens in pictures of that size: the camera's, made larger or smaller as a whole.
/// @throws base::InputError  the size is no such multiple: cropped, or turned.
Lens lens_for(const Lens& lens, int width, int height);

/// The same lens in pictures that were turned clockwise after they were taken, by a multiple of 90
/// degrees: what lay at (x, y) of a picture `height` high lies at (height - y, x) for each 90.
Lens turned(const Lens& lens, int clockwise_deg);

/// The corrected picture, as large as the picture: its middle stays, straight lines are straight.
Picture corrected_picture(const Picture& picture, const Lens& lens);

/// What a person has said of the picture, in the corrected one: boxes around where they come to
/// lie, cut off at the frame.
MeasureOptions corrected_options(const MeasureOptions& options, const Lens& lens);

/// Two points of the picture where the corrected one has them.
ScaleBar corrected_bar(const ScaleBar& bar, const Lens& lens);

/// A box of the corrected picture in the picture.
Box seen_box(const Box& box, const Lens& lens);

}  // namespace repose::vision
