#pragma once

#include <vector>

#include <opencv2/core.hpp>

/// Changes in a scene that are not due to sensors, lamps and codecs.

namespace repose::vision {

/// Shift of a scene in the picture when the camera moves.
class SceneShift {
 public:
  /// @param counts  0 where something moves in front of the scene; empty: every place counts
  explicit SceneShift(const cv::Mat& scene, const cv::Mat& counts = {});

  /// Shift of a frame of the scene's size relative to the scene [px]. 0 if there is no structure,
  /// or if the shift explains less than half of the difference: the light on a plain backdrop and
  /// compression artefacts change while the camera stands still.
  cv::Point2d of(const cv::Mat& frame) const;

 private:
  /// The same for a reduced frame, in its pixels.
  cv::Point2d shift_of(const cv::Mat& seen) const;
  double difference_to(const cv::Mat& now) const;
  cv::Point2d step_to(const cv::Mat& now) const;

  cv::Mat grey_, across_, down_, counts_;  ///< much reduced
};

/// A frame, much reduced, so that little of the sensor's noise is left.
cv::Mat reduced_look(const cv::Mat& frame);

/// 255 where a look differs from an earlier one of the same film; of the looks' size.
///
/// The light may have changed as a whole, in each colour, and row by row through a lamp's flicker;
/// edges may have moved by a fraction of a pixel; isolated places do not count.
cv::Mat changed_places(const cv::Mat& look, const cv::Mat& earlier);

/// 255 at places (of the looks' size) that change repeatedly in both halves of a film, in small
/// regions near the upper or lower edge of the picture: timers and other writing.
/// @param samples  frames from the whole film
cv::Mat writing_in(const std::vector<cv::Mat>& samples);

}  // namespace repose::vision
