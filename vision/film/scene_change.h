#pragma once

#include <vector>

#include <opencv2/core.hpp>

/// What is not as it was in a scene, whatever sensors, lamps and codecs do.

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

/// A frame, much reduced: what is left of the sensor's noise is little.
cv::Mat reduced_look(const cv::Mat& frame);

/// 255 where a look differs from an earlier one of the same film, each place of the looks' size.
///
/// The light may have changed, as a whole, in each colour, and row by row as a lamp's flicker does
/// it; edges may have shivered by a part of a pixel; single places do not count.
cv::Mat changed_places(const cv::Mat& look, const cv::Mat& earlier);

/// Places of the looks' size that change again and again, from the first half of a film to the
/// second, each small and near the upper or lower edge of the picture: timers and other writing.
/// @param samples  frames from all over the film
cv::Mat writing_in(const std::vector<cv::Mat>& samples);

}  // namespace repose::vision
