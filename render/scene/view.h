#pragma once

#include <optional>

#include <Eigen/Core>

#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "vision/picture/picture.h"

namespace repose::render {

/// Maps points of a scene to a picture: the numbers derived from a camera and a picture size.
///
/// Image points are in pixels; (0, 0) is the outer corner of the top left pixel.
struct View {
  PictureSize size;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: right, down, into the picture
  dem::Vector eye = dem::Vector::Zero();  ///< the lens, or the point in the picture's middle
  bool is_perspective = false;
  double scale = 0;           ///< focal length in pixels, or pixels per metre
  vision::Point middle = {};  ///< where the axis meets the picture
  double k1 = 0;
  double k2 = 0;
  /// Distortion is polynomial up to here and linear beyond, so that it never folds.
  double greatest_r = 0;

  /// x right, y down, z into the picture, m from the eye.
  dem::Vector in_camera(const dem::Vector& point) const { return axes * (point - eye); }
  /// std::nullopt for points behind the lens.
  std::optional<vision::Point> project(const dem::Vector& point) const;
  /// Millimetres per pixel in the middle of the picture at depth `depth_m`.
  double mm_per_px(double depth_m) const;
};

/// Distorted distance from the axis, both in focal lengths.
double distorted_r(const View& view, double r);

/// @throws base::InputError  a picture with no or too many pixels, no grains to fit into it,
/// numbers out of range or NaN, a lens that folds the picture, a camera inside the heap or below
/// the ground.
View view_of(const Scene& scene, const Camera& camera, const PictureSize& size);

}  // namespace repose::render
