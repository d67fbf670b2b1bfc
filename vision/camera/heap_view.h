#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

#include "vision/camera/board_pose.h"
#include "vision/camera/lens.h"
#include "vision/picture/picture.h"

namespace repose::vision {

/// How a camera sees the upright plane through the middle of a heap. Directions in camera
/// coordinates: x right, y down, z along the lens's axis. Lengths in millimetres.
struct HeapView {
  double focal_px = 0;
  Point centre;            ///< where the lens's axis meets the picture [px]
  Eigen::Vector3d up;      ///< away from the ground
  Eigen::Vector3d normal;  ///< of the plane, away from the camera, level
  double distance_mm = 0;  ///< of the plane from the lens, along its normal

  /// Direction of a point of the picture, 1 along the axis.
  Eigen::Vector3d direction(Point place) const;
  /// Downward pitch of the camera.
  double pitch_rad() const;
  /// Rotation of the camera about its axis; > 0: the ground's right end is lower.
  double roll_rad() const;
};

/// How a board is set up: nominal values and errors.
struct BoardStand {
  double square_mm = 0;        ///< as printed
  double board_offset_mm = 0;  ///< how far behind the heap's plane
  double roll_rad = 0;         ///< how far its upper side leans away from the camera
  double tilt_rad = 0;         ///< in its own plane: how far its right end is too low
  double turn_rad = 0;         ///< about its vertical axis, from parallel to the heap's plane
};

/// From a board that, apart from those errors, stands upright and parallel to the heap's plane.
HeapView view_by_board(const BoardPose::Numbers& pose, const BoardStand& stand);

/// From a known scale in the heap's plane at `place`; the plane faces the camera.
HeapView view_by_scale(const Lens& lens, double mm_per_px, double pitch_rad, double roll_rad,
                       Point place);

/// A vector of inputs with their covariance.
struct Inputs {
  Eigen::VectorXd values;
  Eigen::MatrixXd covariance;
};

/// The covariance of a function's values, to first order: J C J^T with J by central differences of
/// one standard deviation, so that nonlinearity within that range is included. JCGM 102:2011, 6.2.
Eigen::MatrixXd propagated(const Inputs& inputs,
                           const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function);

}  // namespace repose::vision
