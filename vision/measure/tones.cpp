#include "vision/measure/tones.h"

#include <algorithm>

namespace repose::vision {

std::optional<Tones> tones_of(const cv::Mat3b& bgr) {
  if (bgr.empty()) return std::nullopt;
  Tones tones = {bgr(0, 0), bgr(0, 0)};
  bool has_two = false;
  for (int row = 0; row < bgr.rows; ++row) {
    const cv::Vec3b* const end = bgr[row] + bgr.cols;
    const cv::Vec3b* at = bgr[row];
    const auto is_known = [&](const cv::Vec3b& colour) {
      return colour == tones[0] || colour == tones[1];
    };
    while ((at = std::find_if_not(at, end, is_known)) != end) {
      if (has_two) return std::nullopt;
      has_two = true;
      tones[1] = *at;
    }
  }
  if (!has_two) return std::nullopt;
  return tones;
}

bool is_grey(const Tones& tones) {
  return std::all_of(tones.begin(), tones.end(), [](const cv::Vec3b& tone) {
    return tone[0] == tone[1] && tone[0] == tone[2];
  });
}

}  // namespace repose::vision
