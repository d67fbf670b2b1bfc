#include "vision/track/plate_strip.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace repose::vision {
namespace {

/// Of the last row above the edge, so that none of the plate is mixed in.
constexpr double kAbove_px = 1.5;

}  // namespace

double along_plate(const PlateMotion& motion, int column) {
  const EdgeLine& line = motion.seen.front().line;
  return (cv::Point2d(column, line.row_at(column)) - motion.origin(line)).dot(line.along());
}

PlateStrip strip_above(const PlateMotion& motion, const cv::Size& frame) {
  constexpr double kHeight = .3;
  // Something may hide the end of the edge that it stands on.
  constexpr double kBeyond = .08;
  const int beyond = cvRound(kBeyond * frame.width);
  const double from = along_plate(motion, std::max(0, motion.edge.from - beyond));
  const double to = along_plate(motion, std::min(frame.width - 1, motion.edge.to + beyond));
  return {.from_px = from,
          .size = {std::max(1, cvFloor(to - from)), cvRound(kHeight * frame.height)}};
}

cv::Point2d in_frame(const cv::Point2d& place, const PlateMotion& motion, const EdgeLine& line,
                     const PlateStrip& strip) {
  return motion.origin(line) + (strip.from_px + place.x) * line.along() -
         (kAbove_px + strip.size.height - 1 - place.y) * line.normal();
}

cv::Mat strip_picture(const cv::Mat& frame, const PlateMotion& motion, const EdgeLine& line,
                      const PlateStrip& strip) {
  const cv::Point2d corner = in_frame({0, 0}, motion, line, strip);
  const cv::Point2d along = line.along(), down = line.normal();
  const cv::Matx23d turn(along.x, down.x, corner.x, along.y, down.y, corner.y);
  cv::Mat picture;
  cv::warpAffine(frame, picture, turn, strip.size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  return picture;
}

}  // namespace repose::vision
