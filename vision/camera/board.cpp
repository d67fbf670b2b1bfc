#include "vision/camera/board.h"

#include <algorithm>
#include <cmath>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "vision/camera/markers.h"
#include "vision/picture/mat_of_picture.h"
#include "vision/picture/opencv_threads.h"

namespace repose::vision {
namespace {

constexpr std::size_t kFewestCorners = 6;
// A corner that lies farther from where the others have it is another thing's.
constexpr double kAstray = 0.15;  // of a square

/// Adds a marker's black cells; neighbours in a row are one patch, so that no gap shows in print.
void add_marker(int id, double x, double y, std::vector<BoardPatch>& patches) {
  const cv::Mat1b cells = marker_cells(id);
  const double side = kMarkerPart / cells.cols;
  for (int row = 0; row < cells.rows; ++row) {
    for (int first = 0; first < cells.cols; ++first) {
      if (cells(row, first) != 0) continue;
      int end = first;
      while (end < cells.cols && cells(row, end) == 0) ++end;
      patches.push_back({x + first * side, y + row * side, (end - first) * side, side});
      first = end;
    }
  }
}

/// Those that lie where one plane's view has them.
std::vector<SeenCorner> agreeing(const std::vector<SeenCorner>& corners) {
  if (corners.size() < kFewestCorners) return {};
  std::vector<cv::Point2d> on_board;
  std::vector<cv::Point2d> in_picture;
  for (const SeenCorner& corner : corners) {
    const Point place = board_corner(corner.number);
    on_board.emplace_back(place.x, place.y);
    in_picture.emplace_back(corner.place.x, corner.place.y);
  }
  // From the picture to the board, so that distances are in squares at any size.
  const cv::Mat to_board = cv::findHomography(in_picture, on_board, cv::LMEDS);
  if (to_board.empty()) return {};
  std::vector<cv::Point2d> seen_at;
  cv::perspectiveTransform(in_picture, seen_at, to_board);
  std::vector<SeenCorner> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (cv::norm(seen_at[i] - on_board[i]) < kAstray) kept.push_back(corners[i]);
  }
  return kept.size() < kFewestCorners ? std::vector<SeenCorner>{} : kept;
}

/// Whether the corners lie on a line: then they tell no plane.
bool are_in_line(const std::vector<SeenCorner>& corners) {
  const auto differs = [&](auto coordinate) {
    return std::any_of(corners.begin(), corners.end(), [&](const SeenCorner& corner) {
      return coordinate(corner) != coordinate(corners.front());
    });
  };
  return !differs([](const SeenCorner& corner) { return board_corner(corner.number).x; }) ||
         !differs([](const SeenCorner& corner) { return board_corner(corner.number).y; });
}

}  // namespace

std::vector<BoardPatch> board_patches() {
  std::vector<BoardPatch> patches;
  constexpr double kMargin = (1 - kMarkerPart) / 2;
  int id = 0;
  for (int row = 0; row < kBoardRows; ++row) {
    for (int column = 0; column < kBoardColumns; ++column) {
      if ((row + column) % 2 == 0) {
        patches.push_back({static_cast<double>(column), static_cast<double>(row), 1, 1});
      } else {
        add_marker(id++, column + kMargin, row + kMargin, patches);
      }
    }
  }
  return patches;
}

std::vector<SeenCorner> find_board(const Picture& picture) {
  keep_opencv_to_one_thread();
  cv::Mat1b grey;
  cv::cvtColor(mat_of(picture), grey, cv::COLOR_BGR2GRAY);
  std::vector<SeenCorner> corners = agreeing(detected_corners(grey));
  if (corners.empty() || are_in_line(corners)) return {};
  std::sort(corners.begin(), corners.end(),
            [](const SeenCorner& a, const SeenCorner& b) { return a.number < b.number; });
  return corners;
}

}  // namespace repose::vision
