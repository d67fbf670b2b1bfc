#pragma once

#include <opencv2/core.hpp>

namespace repose::vision {

/// How far a scene lies from where it lay: of cameras that move.
class SceneShift {
 public:
  /// @param counts  0 where something moves before the scene; empty: it counts everywhere
  explicit SceneShift(const cv::Mat& scene, const cv::Mat& counts = {});

  /// Of a frame of the scene's size, from the scene [px]. None where there is nothing to hold on
  /// to, and where the shift does not explain half of what differs: the light on a plain backdrop
  /// and what compression leaves of it change while the camera stands still.
  cv::Point2d of(const cv::Mat& frame) const;

 private:
  /// Of a reduced frame, in its pixels.
  cv::Point2d shift_of(const cv::Mat& seen) const;
  double difference_to(const cv::Mat& now) const;
  cv::Point2d step_to(const cv::Mat& now) const;

  cv::Mat grey_, across_, down_, counts_;  ///< much reduced
};

}  // namespace repose::vision
