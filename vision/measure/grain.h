#pragma once

#include <optional>

#include <opencv2/core/mat.hpp>

#include "vision/measure/working_picture.h"

namespace repose::vision {

/// Typical grain diameter inside the body [working px], from the pattern of light and dark grains.
///
/// The autocorrelation of lightness falls until the lag leaves a grain: at the diameter for grains
/// of random brightness, at 0.6 of it for packed grains with shaded rims. The size is 1.25 times
/// the lag of that elbow, or 1.7 times if the correlation is negative there (packed grains);
/// accurate to a factor of two. Gradual changes in lighting do not shift the elbow. std::nullopt if
/// the body shows no pattern (a silhouette) or is too thin.
std::optional<double> grain_size(const WorkingPicture& work, const cv::Mat1b& body);

}  // namespace repose::vision
