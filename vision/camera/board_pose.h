#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "vision/camera/board.h"
#include "vision/camera/lens.h"

namespace repose::vision {

/// How a camera sees a board: x right, y down, z along the lens's axis, from the lens; lengths in
/// squares. On the board x points right, y down, z away from the viewer.
struct BoardPose {
  static constexpr int kNumbers = 9;
  /// Rotation vector of the board, its origin, ln of the focal length [px], and where the lens's
  /// axis meets the picture [px].
  using Numbers = Eigen::Matrix<double, kNumbers, 1>;
  using Covariance = Eigen::Matrix<double, kNumbers, kNumbers>;

  Numbers numbers = Numbers::Zero();
  Covariance covariance = Covariance::Zero();
  double error_px = 0;  ///< root mean square distance of the corners from the fit
};

/// A pose's rotation: its columns are the board's axes in camera coordinates.
Eigen::Matrix3d rotation_of(const BoardPose::Numbers& numbers);

/// Projects a point of the board, in squares, into the picture [px].
Point seen_at(const BoardPose::Numbers& numbers, Point on_board);

/// Fits the pose to the corners by least squares, along with focal length and centre, which are
/// constrained to the lens's as far as it is known: without a lens, to a focal length of one
/// picture width within a factor of three, and the picture's centre within 3 % of its width.
///
/// The camera can be known to face the board squarely, within an angle (95 % half-width): with an
/// unknown focal length, the orientation of a small board is otherwise undetermined.
///
/// A board that is small in the picture looks the same when tilted the other way; if the corners
/// cannot distinguish the two, their difference is part of the covariance.
///
/// Proved by tests/vision/board_pose_test.cpp on projected corners.
/// @param corners  in the corrected picture, at least six, not in a line
/// @param lens  of pictures of this size; std::nullopt: unknown
BoardPose fit_pose(const std::vector<SeenCorner>& corners, const std::optional<Lens>& lens,
                   int width, int height, std::optional<double> square_within_rad = {});

}  // namespace repose::vision
