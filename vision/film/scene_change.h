#pragma once

#include <vector>

#include <opencv2/core.hpp>

/// What is not as it was in a scene, whatever sensors, lamps and codecs do.
namespace repose::vision {

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
