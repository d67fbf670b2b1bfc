#include "vision/film/comb_finder.h"

#include <cmath>

#include <opencv2/imgproc.hpp>

namespace repose::vision {
namespace {

constexpr int kMoved = 24;    ///< grey levels between two frames
constexpr int kRowStep = 14;  ///< from each row of a comb to the next; noise goes on for fewer rows

/// Whether five rows from this one on go up and down by turns.
bool is_comb(const cv::Mat& grey, int row, int column) {
  int before = 0;
  for (int k = 0; k < 4; ++k) {
    const int step = grey.at<uchar>(row + k + 1, column) - grey.at<uchar>(row + k, column);
    if (std::abs(step) < kRowStep || step * before > 0) return false;
    before = step;
  }
  return true;
}

}  // namespace

void CombFinder::look(const cv::Mat& bgr) {
  constexpr int kRows = 5, kFewestMoved_px = 60;
  constexpr double kCombedPart = .08;
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  cv::swap(grey, before_);  // `grey` is the frame before from here on
  if (grey.size() != before_.size()) return;
  int moved = 0, combed = 0;
  for (int row = 0; row + kRows <= before_.rows; ++row) {
    const uchar* now = before_.ptr<uchar>(row + kRows / 2);
    const uchar* then = grey.ptr<uchar>(row + kRows / 2);
    for (int column = 0; column < before_.cols; ++column) {
      if (std::abs(now[column] - then[column]) < kMoved) continue;
      ++moved;
      combed += is_comb(before_, row, column) ? 1 : 0;
    }
  }
  if (moved < kFewestMoved_px) return;
  ++moving_frames_;
  combed_frames_ += combed > kCombedPart * moved ? 1 : 0;
}

bool CombFinder::is_interlaced() const {
  constexpr int kFewest = 3;
  constexpr double kPart = .3;  // of the frames in which something moves; slow things have no comb
  return combed_frames_ >= kFewest && combed_frames_ >= kPart * moving_frames_;
}

}  // namespace repose::vision
