#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "vision/picture/picture.h"

/// Pictures of the board by cameras that are known exactly, drawn by the formulas alone,
/// independent of the measuring code.
namespace repose::testing {

/// Directions: x right, y down, z ahead. Distortion as OpenCV's.
struct BoardCamera {
  int width = 1280;
  int height = 853;
  double focal_px = 1400;
  double centre_x_px = 640;
  double centre_y_px = 426.5;
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;

  /// Projects a point in front of the camera [px].
  vision::Point seen(const Eigen::Vector3d& place) const;
  /// The direction in which a place in the picture is seen, 1 along the axis.
  Eigen::Vector3d direction(vision::Point place) const;
};

/// Where a board is, in the camera's frame.
struct BoardPlace {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< columns: the board's x, y, z
  Eigen::Vector3d origin_mm = Eigen::Vector3d::Zero();     ///< its top left corner
  double square_mm = 24;
};

/// A board whose middle is at `middle_mm`, facing the camera and then turned: about its vertical
/// axis, its horizontal axis, and in its own plane.
BoardPlace placed_board(const Eigen::Vector3d& middle_mm, double yaw_rad, double pitch_rad,
                        double roll_rad, double square_mm = 24);

/// Rotates a direction in the renderer's world (z up, the camera looking along +y) to the camera's
/// frame.
Eigen::Matrix3d camera_from_world(double pitch_rad, double roll_rad);

struct BoardLook {
  double white = 225;  ///< of 255
  double black = 25;
  double blur_px = 0.6;  ///< standard deviation
  double noise = 2;      ///< standard deviation, of 255
  std::uint64_t seed = 1;
};

/// The box around its sheet in the picture, with a margin for the blur.
vision::Box sheet_box(const BoardCamera& camera, const BoardPlace& place);

/// Draws the board on its sheet over the picture.
void draw_board(const BoardCamera& camera, const BoardPlace& place, const BoardLook& look,
                vision::Picture& picture);

/// The same in front of a grey wall.
vision::Picture board_photo(const BoardCamera& camera, const BoardPlace& place,
                            const BoardLook& look = {});

}  // namespace repose::testing
