#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "vision/measure/repose_angle.h"
#include "vision/measure/scale_bar.h"
#include "vision/picture/picture.h"

/// A camera's lens: how directions map to places in its pictures.
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
/// Proved by tests/vision/lens_test.cpp against the formula, and by rendered pictures.
struct Lens {
  int width = 0;  ///< of the pictures it applies to [px]
  int height = 0;
  LensNumber focal_px = {};
  LensNumber centre_x_px = {};
  LensNumber centre_y_px = {};
  LensNumber k1 = {}, k2 = {}, p1 = {}, p2 = {}, k3 = {};

  bool is_distorted() const;
  /// Maps a point to the corrected picture, which a lens with the same focal length and centre but
  /// without distortion would take; seen() is the inverse.
  Point corrected(Point place) const;
  Point seen(Point place) const;
};

/// The same lens for pictures of another size: the camera's, scaled as a whole.
/// @throws base::InputError  the size is not a multiple: cropped, or rotated.
Lens lens_for(const Lens& lens, int width, int height);

/// The same lens for pictures rotated clockwise after they were taken, by a multiple of 90 degrees:
/// the point (x, y) of a picture `height` high moves to (height - y, x) for each 90.
Lens turned(const Lens& lens, int clockwise_deg);

/// The corrected picture, of the same size: its middle stays, straight lines are straight.
Picture corrected_picture(const Picture& picture, const Lens& lens);

/// The user's hints, mapped to the corrected picture: boxes become boxes around their mapped
/// outline, clipped to the frame.
MeasureOptions corrected_options(const MeasureOptions& options, const Lens& lens);

/// The two points of a scale, mapped to the corrected picture.
ScaleBar corrected_bar(const ScaleBar& bar, const Lens& lens);

/// Maps a box of the corrected picture back to the original.
Box seen_box(const Box& box, const Lens& lens);

}  // namespace repose::vision
