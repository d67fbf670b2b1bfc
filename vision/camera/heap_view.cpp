#include "vision/camera/heap_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace repose::vision {
namespace {

/// The direction without its vertical part, normalised.
Eigen::Vector3d levelled(const Eigen::Vector3d& direction, const Eigen::Vector3d& up) {
  return (direction - direction.dot(up) * up).normalized();
}

struct BoardSides {
  Eigen::Vector3d up;
  Eigen::Vector3d right;
};

/// The board's axes that are closest to up and right in the picture: it may hang sideways or upside
/// down.
BoardSides sides_of(const Eigen::Matrix3d& rotation) {
  const Eigen::Vector3d x = rotation.col(0);
  const Eigen::Vector3d y = rotation.col(1);
  const std::array<BoardSides, 4> all = {BoardSides{-y, x}, {y, -x}, {x, y}, {-x, -y}};
  return *std::min_element(all.begin(), all.end(), [](const BoardSides& a, const BoardSides& b) {
    return a.up.y() < b.up.y();
  });
}

}  // namespace

Eigen::Vector3d HeapView::direction(Point place) const {
  return {(place.x - centre.x) / focal_px, (place.y - centre.y) / focal_px, 1};
}

double HeapView::pitch_rad() const { return std::asin(std::clamp(-up.z(), -1.0, 1.0)); }

double HeapView::roll_rad() const {
  const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(up);
  return std::atan2(right.y(), right.x());
}

HeapView view_by_board(const BoardPose::Numbers& pose, const BoardStand& stand) {
  const Eigen::Matrix3d rotation = rotation_of(pose);
  const BoardSides sides = sides_of(rotation);
  HeapView view{
      .focal_px = std::exp(pose[6]), .centre = {pose[7], pose[8]}, .up = {}, .normal = {}};
  const Eigen::Vector3d away = rotation.col(2);
  view.up = Eigen::AngleAxisd(stand.roll_rad, sides.right) *
            (Eigen::AngleAxisd(-stand.tilt_rad, away) * sides.up);
  view.normal = Eigen::AngleAxisd(stand.turn_rad, view.up) * levelled(away, view.up);
  const Eigen::Vector3d middle =
      rotation * Eigen::Vector3d(kBoardColumns / 2.0, kBoardRows / 2.0, 0) + pose.segment<3>(3);
  view.distance_mm = stand.square_mm * view.normal.dot(middle) - stand.board_offset_mm;
  return view;
}

HeapView view_by_scale(const Lens& lens, double mm_per_px, double pitch_rad, double roll_rad,
                       Point place) {
  HeapView view{.focal_px = lens.focal_px.value,
                .centre = {lens.centre_x_px.value, lens.centre_y_px.value},
                .up = {},
                .normal = {}};
  view.up = {std::sin(roll_rad) * std::cos(pitch_rad), -std::cos(roll_rad) * std::cos(pitch_rad),
             -std::sin(pitch_rad)};
  view.normal = levelled(Eigen::Vector3d::UnitZ(), view.up);
  view.distance_mm = mm_per_px * view.focal_px * view.normal.dot(view.direction(place));
  return view;
}

Eigen::MatrixXd propagated(const Inputs& inputs,
                           const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function) {
  // Steps along the eigenvectors of the correlation: a step of one of several correlated inputs
  // alone may give an impossible pose. The correlation is used because units differ.
  const Eigen::VectorXd deviations = inputs.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  const Eigen::VectorXd weights =
      deviations.unaryExpr([](double sd) { return sd > 0 ? 1 / sd : 0; });
  const Eigen::MatrixXd correlation =
      weights.asDiagonal() * inputs.covariance * weights.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(correlation);
  Eigen::MatrixXd covariance;
  for (Eigen::Index i = 0; i < inputs.values.size(); ++i) {
    const double variance = axes.eigenvalues()[i];
    if (variance <= 0) continue;
    const Eigen::VectorXd step =
        std::sqrt(variance) * deviations.cwiseProduct(axes.eigenvectors().col(i));
    const Eigen::VectorXd change =
        (function(inputs.values + step) - function(inputs.values - step)) / 2;
    if (covariance.size() == 0) covariance = Eigen::MatrixXd::Zero(change.size(), change.size());
    covariance += change * change.transpose();
  }
  return covariance;
}

}  // namespace repose::vision
