#pragma once

#include <optional>

#include <Eigen/Core>

#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "vision/picture/picture.h"

namespace repose::render {

/// Where the points of a scene are in a picture: a camera and a picture's size, put to numbers.
///
/// Image points are in pixels, (0, 0) the outer corner of the top left pixel.
struct View {
  PictureSize size;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: right, down, into the picture
  dem::Vector eye = dem::Vector::Zero();  ///< lens, or the point in the middle of the picture
  bool is_perspective = false;
  double scale = 0;           ///< focal length in pixels, or pixels to a metre
  vision::Point middle = {};  ///< where the axis meets the picture
  double k1 = 0;
  double k2 = 0;
  /// Distortion is a polynomial up to here and goes on straight beyond, so that it never folds.
  double greatest_r = 0;

  /// x right, y down, z into the picture, m from the eye.
  dem::Vector in_camera(const dem::Vector& point) const { return axes * (point - eye); }
  /// None for points behind the lens.
  std::optional<vision::Point> project(const dem::Vector& point) const;
  /// Millimetres to a pixel at a depth, m, in the middle of the picture.
  double mm_per_px(double depth_m) const;
};

/// Distorted distance from the axis, both in focal lengths.
double distorted_r(const View& view, double r);

/// @throws base::InputError  a picture without pixels or of too many, no grains to fit into
/// it, numbers that are none, a lens that folds the picture, a camera inside the heap or under the
/// ground.
View view_of(const Scene& scene, const Camera& camera, const PictureSize& size);

}  // namespace repose::render
