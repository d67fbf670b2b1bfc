#include "vision/camera/board_view.h"

#include <algorithm>
#include <cmath>

#include "base/distributions.h"
#include "base/units.h"

namespace repose::vision {
namespace {

// Half-widths of what is done by eye.
constexpr double kLean_rad = 1 * kDegree;    // a board set upright
constexpr double kPlaced_mm = 10;            // ... in its plane
constexpr double kTurned_rad = 3 * kDegree;  // ... and parallel to it

enum : int { k_origin_x = 3, k_origin_y, k_origin_z };  // of the pose

/// The pose with its origin as x / z, y / z and ln z: if the focal length is unknown, its logarithm
/// and that of the distance vary strongly together without changing the view.
BoardPose::Numbers by_distance(const BoardPose::Numbers& pose) {
  BoardPose::Numbers numbers = pose;
  numbers[k_origin_x] /= pose[k_origin_z];
  numbers[k_origin_y] /= pose[k_origin_z];
  numbers[k_origin_z] = std::log(pose[k_origin_z]);
  return numbers;
}

BoardPose::Numbers pose_of(const BoardPose::Numbers& numbers) {
  BoardPose::Numbers pose = numbers;
  pose[k_origin_z] = std::exp(numbers[k_origin_z]);
  pose[k_origin_x] *= pose[k_origin_z];
  pose[k_origin_y] *= pose[k_origin_z];
  return pose;
}

BoardPose::Covariance slopes_by_distance(const BoardPose::Numbers& pose) {
  BoardPose::Covariance slopes = BoardPose::Covariance::Identity();
  const double z = pose[k_origin_z];
  slopes(k_origin_x, k_origin_x) = slopes(k_origin_y, k_origin_y) = slopes(k_origin_z, k_origin_z) =
      1 / z;
  slopes(k_origin_x, k_origin_z) = -pose[k_origin_x] / (z * z);
  slopes(k_origin_y, k_origin_z) = -pose[k_origin_y] / (z * z);
  return slopes;
}

enum : int { k_lean = BoardPose::kNumbers, k_tilt, k_turn, k_behind, k_inputs };

/// Margins of the sheet around the board to exclude, in squares: the text printed below the board
/// is part of the sheet.
constexpr double kBesideBoard = 1.25, kAbove = 0.6, kIndent = 1.4;

/// The visible part of the board: all of it, or what the heap does not hide.
Segment part_seen(const std::vector<SeenCorner>& corners) {
  Segment part{{1e9, 1e9}, {-1e9, -1e9}};
  for (const SeenCorner& corner : corners) {
    const Point place = board_corner(corner.number);
    part.from = {std::min(part.from.x, place.x), std::min(part.from.y, place.y)};
    part.to = {std::max(part.to.x, place.x), std::max(part.to.y, place.y)};
  }
  return {{part.from.x - 1 - kBesideBoard, part.from.y - 1 - kAbove},
          {part.to.x + 1 + kBesideBoard, part.to.y + 1 + kIndent}};
}

}  // namespace

BoardView::BoardView(const BoardPose& pose, const BoardPlacing& placing)
    : inputs_{.values = Eigen::VectorXd::Zero(k_inputs),
              .covariance = Eigen::MatrixXd::Zero(k_inputs, k_inputs)},
      square_mm_(placing.square_mm) {
  inputs_.values.head<BoardPose::kNumbers>() = by_distance(pose.numbers);
  const BoardPose::Covariance slopes = slopes_by_distance(pose.numbers);
  inputs_.covariance.topLeftCorner<BoardPose::kNumbers, BoardPose::kNumbers>() =
      slopes * pose.covariance * slopes.transpose();
  inputs_.values[k_behind] = placing.board_offset_mm;
  inputs_.covariance(k_lean, k_lean) = std::pow(kLean_rad / base::kNormal95, 2);
  inputs_.covariance(k_tilt, k_tilt) = std::pow(kLean_rad / base::kNormal95, 2);
  inputs_.covariance(k_turn, k_turn) = std::pow(kTurned_rad / base::kNormal95, 2);
  inputs_.covariance(k_behind, k_behind) = std::pow(kPlaced_mm / base::kNormal95, 2);
}

HeapView BoardView::view(const Eigen::VectorXd& values) const {
  return view_by_board(pose_of(values.head<BoardPose::kNumbers>()),
                       {.square_mm = square_mm_,
                        .board_offset_mm = values[k_behind],
                        .roll_rad = values[k_lean],
                        .tilt_rad = values[k_tilt],
                        .turn_rad = values[k_turn]});
}

void BoardView::take_pitch(double pitch_rad) {
  constexpr double kTold_rad = 0.25 * kDegree;
  inputs_.values[k_lean] += pitch_rad - view().pitch_rad();
  // The corners' own information on it is now contained in the lean.
  inputs_.covariance(k_lean, k_lean) = std::pow(kTold_rad / base::kNormal95, 2);
}

Estimate BoardView::estimate(const std::function<double(const HeapView&)>& number) const {
  const Eigen::MatrixXd covariance =
      propagated(inputs_, [&](const Eigen::VectorXd& values) -> Eigen::VectorXd {
        return Eigen::VectorXd::Constant(1, number(view(values)));
      });
  return {number(view()), base::kNormal95 * std::sqrt(covariance(0, 0))};
}

std::vector<Point> sheet_outline(const BoardPose& pose, const std::vector<SeenCorner>& corners) {
  const auto& [from, to] = part_seen(corners);
  std::vector<Point> outline;
  for (const Point corner : {from, Point{to.x, from.y}, to, Point{from.x, to.y}}) {
    outline.push_back(seen_at(pose.numbers, corner));
  }
  return outline;
}

double mm_per_px_along(const HeapView& view, Point place, Point along) {
  const double length = std::hypot(along.x, along.y);
  const Point half{along.x / length / 2, along.y / length / 2};
  const auto in_plane = [&](double sign) -> Eigen::Vector3d {
    const Eigen::Vector3d ray = view.direction({place.x + sign * half.x, place.y + sign * half.y});
    return ray * (view.distance_mm / ray.dot(view.normal));
  };
  return (in_plane(1) - in_plane(-1)).norm();
}

}  // namespace repose::vision
