// The only file that depends on how OpenCV finds markers: in its module aruco, and from 4.7 on in
// objdetect, where dictionaries and boards are no longer shared pointers.

#include "vision/camera/markers.h"

#include <opencv2/core/version.hpp>

#if CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 7)
#define REPOSE_MARKERS_IN_OBJDETECT 1
#include <opencv2/objdetect/aruco_detector.hpp>
#include <opencv2/objdetect/charuco_detector.hpp>
#else
#define REPOSE_MARKERS_IN_OBJDETECT 0
#include <opencv2/aruco/charuco.hpp>
#endif

namespace repose::vision {
namespace {

constexpr int kCells = 6;  // along a marker's side: 4 and the border

// With fewer, the visible part of the board is too small to be certain.
constexpr int kFewestMarkers = 2;

struct Found {
  std::vector<cv::Point2f> places;
  std::vector<int> numbers;
};

#if REPOSE_MARKERS_IN_OBJDETECT

const cv::aruco::Dictionary& dictionary() {
  static const auto the_one = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50);
  return the_one;
}

void draw_marker(int id, cv::Mat& cells) {
  cv::aruco::generateImageMarker(dictionary(), id, kCells, cells, 1);
}

Found found_in(const cv::Mat1b& grey) {
  const cv::aruco::CharucoBoard board({kBoardColumns, kBoardRows}, 1.0F,
                                      static_cast<float>(kMarkerPart), dictionary());
  cv::aruco::CharucoParameters of_board;
  of_board.minMarkers = kFewestMarkers;
  of_board.tryRefineMarkers = true;
  const cv::aruco::CharucoDetector detector(board, of_board);
  Found found;
  detector.detectBoard(grey, found.places, found.numbers);
  return found;
}

#else

const cv::Ptr<cv::aruco::Dictionary>& dictionary() {
  static const auto the_one = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50);
  return the_one;
}

void draw_marker(int id, cv::Mat& cells) {
  cv::aruco::drawMarker(dictionary(), id, kCells, cells, 1);
}

Found found_in(const cv::Mat1b& grey) {
  const auto board = cv::aruco::CharucoBoard::create(kBoardColumns, kBoardRows, 1.0F,
                                                     static_cast<float>(kMarkerPart), dictionary());
  std::vector<std::vector<cv::Point2f> > markers;
  std::vector<std::vector<cv::Point2f> > rejected;
  std::vector<int> ids;
  cv::aruco::detectMarkers(grey, dictionary(), markers, ids,
                           cv::aruco::DetectorParameters::create(), rejected);
  cv::aruco::refineDetectedMarkers(grey, board, markers, ids, rejected);
  Found found;
  if (ids.empty()) return found;
  cv::aruco::interpolateCornersCharuco(markers, ids, grey, board, found.places, found.numbers,
                                       cv::noArray(), cv::noArray(), kFewestMarkers);
  return found;
}

#endif

}  // namespace

cv::Mat1b marker_cells(int id) {
  cv::Mat cells;
  draw_marker(id, cells);
  return cells;
}

std::vector<SeenCorner> detected_corners(const cv::Mat1b& grey) {
  const Found found = found_in(grey);
  std::vector<SeenCorner> corners;
  for (std::size_t i = 0; i < found.numbers.size(); ++i) {
    corners.push_back(
        {.number = found.numbers[i], .place = {found.places[i].x, found.places[i].y}});
  }
  return corners;
}

}  // namespace repose::vision
