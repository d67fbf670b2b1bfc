#pragma once

#include <array>
#include <optional>

#include <opencv2/core/mat.hpp>

namespace repose::vision {

/// Two colours, as in a mask or a rendered silhouette.
using Tones = std::array<cv::Vec3b, 2>;

/// The two colours of a picture in which every pixel is one or the other. Empty for all other
/// pictures.
std::optional<Tones> tones_of(const cv::Mat3b& bgr);

bool is_grey(const Tones& tones);

}  // namespace repose::vision
