#include "calibrate/report/picture_data.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/base64.h"

namespace repose::calibrate::report {

PageJpeg page_jpeg(const vision::Picture& picture, int longest_side_px) {
  constexpr int kQuality = 82;
  const vision::Picture shown = vision::reduced(picture, longest_side_px);
  return {.bytes = vision::jpeg_of(shown, kQuality), .width = shown.width, .height = shown.height};
}

ShownPicture shown_jpeg(const PageJpeg& jpeg, const std::string& alt, const std::string& caption) {
  return {
      .data_uri = "data:image/jpeg;base64," + base::base64_of(std::as_bytes(std::span(jpeg.bytes))),
      .width = jpeg.width,
      .height = jpeg.height,
      .alt = alt,
      .caption = caption,
      .picture_width = jpeg.picture_width,
      .picture_height = jpeg.picture_height,
      .area = jpeg.area};
}

ShownPicture shown_picture(const vision::Picture& picture, int longest_side_px,
                           const std::string& alt, const std::string& caption) {
  return shown_jpeg(page_jpeg(picture, longest_side_px), alt, caption);
}

int longest_side_px(std::size_t pictures) {
  // Some 120 kB a picture of 1000 px; together not much more than 0.6 MB.
  constexpr double kLargest = 1000, kSmallest = 160, kFullSized = 5;
  const double fraction = kFullSized / std::max(kFullSized, static_cast<double>(pictures));
  return static_cast<int>(std::max(kSmallest, kLargest * std::sqrt(fraction)));
}

}  // namespace repose::calibrate::report
