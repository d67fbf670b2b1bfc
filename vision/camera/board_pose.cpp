#include "vision/camera/board_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <opencv2/calib3d.hpp>

#include "base/distributions.h"

namespace repose::vision {
namespace {

// Paper is not quite flat, and similar corners have similar errors: no corner is known better.
constexpr double kMinDeviation_px = 0.05;

/// Prior values of the lens's three numbers, with their standard deviations.
struct Prior {
  double log_focal = 0;
  double log_focal_sd = 0;
  Point centre;
  double centre_x_sd = 0;
  double centre_y_sd = 0;
};

Prior prior_of(const std::optional<Lens>& lens, int width, int height) {
  // Exact values would leave nothing to be fitted.
  constexpr double kMinFocal = 1e-5, kMinCentre_px = 1e-3;
  if (lens) {
    const double focal = lens->focal_px.value;
    return {
        .log_focal = std::log(focal),
        .log_focal_sd = std::max(kMinFocal, lens->focal_px.uncertainty / focal / base::kNormal95),
        .centre = {lens->centre_x_px.value, lens->centre_y_px.value},
        .centre_x_sd = std::max(kMinCentre_px, lens->centre_x_px.uncertainty / base::kNormal95),
        .centre_y_sd = std::max(kMinCentre_px, lens->centre_y_px.uncertainty / base::kNormal95)};
  }
  constexpr double kFactor = 3, kOffCentre = 0.03;
  const double longest = std::max(width, height);
  return {.log_focal = std::log(longest),
          .log_focal_sd = std::log(kFactor) / base::kNormal95,
          .centre = {width / 2.0, height / 2.0},
          .centre_x_sd = kOffCentre * longest / base::kNormal95,
          .centre_y_sd = kOffCentre * longest / base::kNormal95};
}

/// Distance between a corner as seen and as predicted [standard deviations].
struct CornerError {
  Point on_board;
  Point place;
  double deviation_px;

  template <typename T>
  bool operator()(const T* numbers, T* residual) const {
    const std::array<T, 3> board = {T(on_board.x), T(on_board.y), T(0)};
    std::array<T, 3> here = {};
    ceres::AngleAxisRotatePoint(numbers, board.data(), here.data());
    const T depth = here[2] + numbers[5];
    const T focal = exp(numbers[6]);
    residual[0] = (focal * (here[0] + numbers[3]) / depth + numbers[7] - place.x) / deviation_px;
    residual[1] = (focal * (here[1] + numbers[4]) / depth + numbers[8] - place.y) / deviation_px;
    return true;
  }
};

struct PriorError {
  Prior prior;

  template <typename T>
  bool operator()(const T* numbers, T* residual) const {
    residual[0] = (numbers[6] - prior.log_focal) / prior.log_focal_sd;
    residual[1] = (numbers[7] - prior.centre.x) / prior.centre_x_sd;
    residual[2] = (numbers[8] - prior.centre.y) / prior.centre_y_sd;
    return true;
  }
};

/// Deviation of the board's normal from the camera's axis, horizontally and vertically.
struct SquareError {
  double deviation;

  template <typename T>
  bool operator()(const T* numbers, T* residual) const {
    const std::array<T, 3> board = {T(0), T(0), T(1)};
    std::array<T, 3> normal = {};
    ceres::AngleAxisRotatePoint(numbers, board.data(), normal.data());
    residual[0] = normal[0] / deviation;
    residual[1] = normal[1] / deviation;
    return true;
  }
};

struct Minimum {
  BoardPose::Numbers numbers;
  BoardPose::Covariance covariance;
  double cost = std::numeric_limits<double>::infinity();  // sum of squares / 2
};

Minimum minimum_from(const BoardPose::Numbers& start, const std::vector<SeenCorner>& corners,
                     const Prior& prior, std::optional<double> square_within_rad,
                     double deviation_px) {
  Minimum minimum{.numbers = start, .covariance = BoardPose::Covariance::Zero()};
  double* numbers = minimum.numbers.data();
  ceres::Problem problem;
  for (const SeenCorner& corner : corners) {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<CornerError, 2, BoardPose::kNumbers>(
            new CornerError{board_corner(corner.number), corner.place, deviation_px}),
        nullptr, numbers);
  }
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<PriorError, 3, BoardPose::kNumbers>(new PriorError{prior}),
      nullptr, numbers);
  if (square_within_rad) {
    const double deviation = std::sin(*square_within_rad) / base::kNormal95;
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<SquareError, 2, BoardPose::kNumbers>(
                                 new SquareError{deviation}),
                             nullptr, numbers);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return minimum;
  minimum.cost = summary.final_cost;
  ceres::Problem::EvaluateOptions all;
  ceres::CRSMatrix rows;
  problem.Evaluate(all, nullptr, nullptr, nullptr, &rows);
  BoardPose::Covariance information = BoardPose::Covariance::Zero();
  for (int row = 0; row < rows.num_rows; ++row) {
    BoardPose::Numbers gradient = BoardPose::Numbers::Zero();
    for (int i = rows.rows[row]; i < rows.rows[row + 1]; ++i)
      gradient[rows.cols[i]] = rows.values[i];
    information += gradient * gradient.transpose();
  }
  minimum.covariance = information.ldlt().solve(BoardPose::Covariance::Identity());
  return minimum;
}

/// The two tilts for which the corners look most alike.
std::vector<BoardPose::Numbers> starts_for(const std::vector<SeenCorner>& corners,
                                           const Prior& prior) {
  std::vector<cv::Point3d> on_board;
  std::vector<cv::Point2d> in_picture;
  for (const SeenCorner& corner : corners) {
    const Point place = board_corner(corner.number);
    on_board.emplace_back(place.x, place.y, 0);
    in_picture.emplace_back(corner.place.x, corner.place.y);
  }
  const double focal = std::exp(prior.log_focal);
  const cv::Matx33d matrix(focal, 0, prior.centre.x, 0, focal, prior.centre.y, 0, 0, 1);
  std::vector<cv::Mat> turns;
  std::vector<cv::Mat> places;
  cv::solvePnPGeneric(on_board, in_picture, matrix, cv::noArray(), turns, places, false,
                      cv::SOLVEPNP_IPPE);
  std::vector<BoardPose::Numbers> starts;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    BoardPose::Numbers start;
    for (int k = 0; k < 3; ++k) {
      start[k] = turns[i].at<double>(k);
      start[3 + k] = places[i].at<double>(k);
    }
    start[6] = prior.log_focal;
    start[7] = prior.centre.x;
    start[8] = prior.centre.y;
    starts.push_back(start);
  }
  return starts;
}

double error_of(const BoardPose::Numbers& numbers, const std::vector<SeenCorner>& corners) {
  double squares = 0;
  for (const SeenCorner& corner : corners) {
    const Point place = seen_at(numbers, board_corner(corner.number));
    squares += std::pow(place.x - corner.place.x, 2) + std::pow(place.y - corner.place.y, 2);
  }
  return std::sqrt(squares / static_cast<double>(corners.size()));
}

/// The best of the minima; its difference from a rival that fits nearly as well is part of the
/// covariance.
Minimum best_of(const std::vector<Minimum>& minima) {
  const auto best = std::min_element(minima.begin(), minima.end(),
                                     [](const auto& a, const auto& b) { return a.cost < b.cost; });
  Minimum result = *best;
  for (const Minimum& other : minima) {
    constexpr double kTellsApart = 4.5;  // three standard deviations
    constexpr double kSame = 1e-6;
    const BoardPose::Numbers away = other.numbers - result.numbers;
    if (other.cost - result.cost > kTellsApart || away.norm() < kSame) continue;
    result.covariance += away * away.transpose() / 4;
  }
  return result;
}

}  // namespace

Eigen::Matrix3d rotation_of(const BoardPose::Numbers& numbers) {
  const Eigen::Vector3d turn = numbers.head<3>();
  const double angle_rad = turn.norm();
  if (angle_rad == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle_rad, turn / angle_rad).toRotationMatrix();
}

Point seen_at(const BoardPose::Numbers& numbers, Point on_board) {
  const Eigen::Vector3d place =
      rotation_of(numbers) * Eigen::Vector3d(on_board.x, on_board.y, 0) + numbers.segment<3>(3);
  const double focal = std::exp(numbers[6]);
  return {focal * place.x() / place.z() + numbers[7], focal * place.y() / place.z() + numbers[8]};
}

BoardPose fit_pose(const std::vector<SeenCorner>& corners, const std::optional<Lens>& lens,
                   int width, int height, std::optional<double> square_within_rad) {
  const Prior prior = prior_of(lens, width, height);
  std::vector<BoardPose::Numbers> starts = starts_for(corners, prior);
  constexpr double kFirstGuess_px = 0.2;
  double deviation_px = kFirstGuess_px;
  Minimum best;
  for (int round = 0; round < 2; ++round) {
    std::vector<Minimum> minima;
    for (const BoardPose::Numbers& start : starts) {
      minima.push_back(minimum_from(start, corners, prior, square_within_rad, deviation_px));
    }
    best = best_of(minima);
    for (std::size_t i = 0; i < starts.size(); ++i) starts[i] = minima[i].numbers;
    const double freedom = std::max(1.0, 2.0 * static_cast<double>(corners.size()) - 8);
    const double squares =
        std::pow(error_of(best.numbers, corners), 2) * static_cast<double>(corners.size());
    deviation_px = std::max(kMinDeviation_px, std::sqrt(squares / freedom));
  }
  return {.numbers = best.numbers,
          .covariance = best.covariance,
          .error_px = error_of(best.numbers, corners)};
}

}  // namespace repose::vision
