#pragma once

#include <opencv2/core.hpp>

namespace repose::vision {

/// Tells interlaced films: every other row of a frame was taken half a frame later, so that what
/// moves has a comb for an edge. Where something has moved since the frame before, rows that go up
/// and down by turns are counted.
class CombFinder {
 public:
  /// Frames in their order; some may be left out.
  void look(const cv::Mat& bgr);

  /// Whether enough of the frames in which something moves are combed.
  bool is_interlaced() const;

 private:
  cv::Mat before_;
  int combed_frames_ = 0;
  int moving_frames_ = 0;
};

}  // namespace repose::vision
