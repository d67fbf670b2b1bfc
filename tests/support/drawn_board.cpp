#include "tests/support/drawn_board.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include "tests/support/heap_random.h"
#include "vision/camera/board.h"
#include "vision/picture/opencv.h"

namespace repose::testing {
namespace {

using Eigen::Vector3d;
using vision::Point;

// The sheet around the board, in squares: the margins of an A4 page.
constexpr double kSameEdgeTolerance = 1.15, kAbove = 0.4, kNoteIndent = 1.3;

/// Black inside a patch. A table of fine cells, as there are 400 patches and millions of pixels.
class BoardPattern {
 public:
  BoardPattern() : cells_(vision::kBoardRows * kCells, vision::kBoardColumns * kCells, kWhite) {
    for (const vision::BoardPatch& patch : vision::board_patches()) {
      const auto cell = [](double squares) {
        return static_cast<int>(std::lround(squares * kCells));
      };
      cells_(cv::Rect(cell(patch.x), cell(patch.y), cell(patch.width), cell(patch.height))) = 0;
    }
  }

  /// In squares, inside the board.
  bool is_black(double x, double y) const {
    const auto cell = [](double squares, int most) {
      return std::clamp(static_cast<int>(squares * kCells), 0, most - 1);
    };
    return cells_(cell(y, cells_.rows), cell(x, cells_.cols)) == 0;
  }

 private:
  static constexpr int kCells = 8;  // the finest detail is an eighth of a square
  static constexpr unsigned char kWhite = 255;
  cv::Mat1b cells_;
};

bool is_on_sheet(double x, double y) {
  return x >= -kSameEdgeTolerance && x <= vision::kBoardColumns + kSameEdgeTolerance &&
         y >= -kAbove && y <= vision::kBoardRows + kNoteIndent;
}

/// The whole sheet with a margin for its blur.
cv::Rect frame_of(const BoardCamera& camera, const BoardPlace& place) {
  constexpr int kSteps = 8, kBlur_px = 8;
  std::vector<cv::Point> points;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const double x =
          -kSameEdgeTolerance + (vision::kBoardColumns + 2 * kSameEdgeTolerance) * i / kSteps;
      const double y = -kAbove + (vision::kBoardRows + kAbove + kNoteIndent) * j / kSteps;
      const Point seen =
          camera.seen(place.origin_mm + place.square_mm * place.rotation * Vector3d(x, y, 0));
      points.emplace_back(cvRound(seen.x), cvRound(seen.y));
    }
  }
  const cv::Rect box = cv::boundingRect(points);
  return {box.x - kBlur_px, box.y - kBlur_px, box.width + 2 * kBlur_px, box.height + 2 * kBlur_px};
}

}  // namespace

Point BoardCamera::seen(const Vector3d& place) const {
  const double x = place.x() / place.z();
  const double y = place.y() / place.z();
  const double r2 = x * x + y * y;
  const double radial = 1 + k1 * r2 + k2 * r2 * r2 + k3 * r2 * r2 * r2;
  return {focal_px * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) + centre_x_px,
          focal_px * (y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y) + centre_y_px};
}

Vector3d BoardCamera::direction(Point place) const {
  Vector3d direction((place.x - centre_x_px) / focal_px, (place.y - centre_y_px) / focal_px, 1);
  for (int round = 0; round < 12; ++round) {
    const Point there = seen(direction);
    direction.x() += (place.x - there.x) / focal_px;
    direction.y() += (place.y - there.y) / focal_px;
  }
  return direction;
}

BoardPlace placed_board(const Vector3d& middle_mm, double yaw_rad, double pitch_rad,
                        double roll_rad, double square_mm) {
  BoardPlace place{.square_mm = square_mm};
  place.rotation = (Eigen::AngleAxisd(yaw_rad, Vector3d::UnitY()) *
                    Eigen::AngleAxisd(pitch_rad, Vector3d::UnitX()) *
                    Eigen::AngleAxisd(roll_rad, Vector3d::UnitZ()))
                       .toRotationMatrix();
  const Vector3d half(vision::kBoardColumns * square_mm / 2, vision::kBoardRows * square_mm / 2, 0);
  place.origin_mm = middle_mm - place.rotation * half;
  return place;
}

Eigen::Matrix3d camera_from_world(double pitch_rad, double roll_rad) {
  const Vector3d right(1, 0, 0);
  const Vector3d ahead(0, std::cos(pitch_rad), -std::sin(pitch_rad));
  const Vector3d down = ahead.cross(right);
  Eigen::Matrix3d rows;
  rows.row(0) = std::cos(roll_rad) * right - std::sin(roll_rad) * down;
  rows.row(1) = std::sin(roll_rad) * right + std::cos(roll_rad) * down;
  rows.row(2) = ahead;
  return rows;
}

vision::Box sheet_box(const BoardCamera& camera, const BoardPlace& place) {
  const cv::Rect box = frame_of(camera, place) & cv::Rect(0, 0, camera.width, camera.height);
  return {.x = box.x, .y = box.y, .width = box.width, .height = box.height};
}

void draw_board(const BoardCamera& camera, const BoardPlace& place, const BoardLook& look,
                vision::Picture& picture) {
  static const BoardPattern pattern;
  constexpr int kSamples = 4;  // per side of each pixel
  cv::Mat target = vision::mat_of(picture);
  cv::Mat1f colour = cv::Mat1f::zeros(target.size());
  cv::Mat1f cover = cv::Mat1f::zeros(target.size());
  const Eigen::Matrix3d to_board = place.rotation.transpose();
  const Vector3d eye = to_board * -place.origin_mm;  // in the board's frame
  const cv::Rect shown = frame_of(camera, place) & cv::Rect({}, target.size());
  for (int row = shown.y; row < shown.br().y; ++row) {
    for (int col = shown.x; col < shown.br().x; ++col) {
      // Directions change linearly within a pixel.
      const Vector3d middle = to_board * camera.direction({col + 0.5, row + 0.5});
      const double step = 1 / (camera.focal_px * kSamples);
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const int down = i / kSamples;
        const int across = i - down * kSamples;
        const double aside = (across - (kSamples - 1) / 2.0) * step;
        const double below = (down - (kSamples - 1) / 2.0) * step;
        const Vector3d direction = middle + aside * to_board.col(0) + below * to_board.col(1);
        const Vector3d at = (eye - eye.z() / direction.z() * direction) / place.square_mm;
        if (!is_on_sheet(at.x(), at.y())) continue;
        const bool is_on_board = at.x() >= 0 && at.x() < vision::kBoardColumns && at.y() >= 0 &&
                                 at.y() < vision::kBoardRows;
        const bool is_black = is_on_board && pattern.is_black(at.x(), at.y());
        colour(row, col) += static_cast<float>(is_black ? look.black : look.white);
        cover(row, col) += 1;
      }
    }
  }
  const double all = kSamples * kSamples;
  cv::GaussianBlur(colour / all, colour, {}, look.blur_px);
  cv::GaussianBlur(cover / all, cover, {}, look.blur_px);
  Random random(look.seed);
  for (int row = shown.y; row < shown.br().y; ++row) {
    for (int col = shown.x; col < shown.br().x; ++col) {
      if (cover(row, col) <= 0) continue;
      const double noise = look.noise * random.normal(0, 1);
      for (int c = 0; c < 3; ++c) {
        auto& value = target.at<cv::Vec3b>(row, col)[c];
        value = cv::saturate_cast<unsigned char>(colour(row, col) + (1 - cover(row, col)) * value +
                                                 noise);
      }
    }
  }
}

vision::Picture board_photo(const BoardCamera& camera, const BoardPlace& place,
                            const BoardLook& look) {
  vision::Picture picture = vision::blank_picture(camera.width, camera.height);
  constexpr unsigned char kWall = 140;
  std::fill(picture.bgr.begin(), picture.bgr.end(), kWall);
  draw_board(camera, place, look, picture);
  return picture;
}

}  // namespace repose::testing
