#include "vision/hints/painted_mask.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "vision/picture/opencv.h"

namespace repose::vision {

namespace {

/// Grey: undecided; white: heap; black: not heap.
constexpr std::uint8_t kNothing = 128;

double level_of(BrushStroke::Says says) {
  if (says == BrushStroke::Says::nothing) return kNothing;
  return says == BrushStroke::Says::heap ? 255 : 0;
}

}  // namespace

Picture painted(Picture mask, int width, int height, const std::vector<BrushStroke>& strokes) {
  if (mask.empty()) {
    mask = blank_picture(width, height);
    std::ranges::fill(mask.bgr, kNothing);
  }
  if (mask.width != width || mask.height != height) {
    throw base::InputError({.where = "mask",
                            .value = fmt::format("is {} x {} pixels, the picture {} x {}",
                                                 mask.width, mask.height, width, height),
                            .rule = "the same size"});
  }
  cv::Mat image = mat_of(mask);
  for (const BrushStroke& stroke : strokes) {
    const double level = level_of(stroke.says);
    const cv::Scalar colour(level, level, level);
    const int thickness = std::max(1, static_cast<int>(std::lround(stroke.width_px)));
    const auto at = [](const Point& place) {
      return cv::Point(static_cast<int>(std::lround(place.x)),
                       static_cast<int>(std::lround(place.y)));
    };
    for (std::size_t k = 0; k < stroke.path.size(); ++k) {
      // Without anti-aliasing: grey between white and black would mean undecided.
      cv::line(image, at(stroke.path[k == 0 ? 0 : k - 1]), at(stroke.path[k]), colour, thickness);
    }
  }
  return mask;
}

std::filesystem::path mask_file_of(const std::filesystem::path& picture) {
  std::filesystem::path file = picture;
  file += ".repose.mask";
  return file;
}

void save_mask(Hints& hints, const std::filesystem::path& picture) {
  constexpr int kFull_deg = 360;
  hints.mask_file = mask_file_of(picture);
  const std::vector<std::uint8_t> content =
      png_of(turned(hints.mask, (kFull_deg - hints.turn_deg) % kFull_deg));
  base::write_whole_file(hints.mask_file, std::as_bytes(std::span(content)));
}

}  // namespace repose::vision
