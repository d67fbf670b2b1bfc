#include "vision/picture/decoding.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <vector>

#include <libexif/exif-data.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "base/input_error.h"
#include "vision/picture/opencv.h"

namespace repose::vision {

namespace {

constexpr double kFullRange16 = 65535;
constexpr double kOpaque = 255;

cv::Mat colours_to_8_bit(const cv::Mat& colours) {
  if (colours.depth() == CV_8U) return colours;
  double brightest = 0;
  cv::minMaxLoc(colours.reshape(1), nullptr, &brightest);
  const bool is_stretched = brightest >= kFullRange16 / 4 || brightest == 0;
  cv::Mat result;
  colours.convertTo(result, CV_8U, 255 / (is_stretched ? kFullRange16 : brightest));
  return result;
}

/// Mean brightness of a BGR picture, pixels weighted by opacity.
double mean_brightness(const cv::Mat& bgr, const cv::Mat& alpha) {
  const double opacity = cv::sum(alpha)[0];
  if (opacity == 0) {
    throw base::InputError({.value = "every pixel is transparent, so nothing is visible",
                            .fix = "save it without transparency."});
  }
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  return grey.dot(alpha) / opacity;
}

void lay_over(double background, const cv::Mat& alpha, cv::Mat& bgr) {
  const auto backdrop = static_cast<int>(background);
  for (int y = 0; y < bgr.rows; ++y) {
    cv::Vec3b* colours = bgr.ptr<cv::Vec3b>(y);
    const std::uint8_t* opacities = alpha.ptr<std::uint8_t>(y);
    for (int x = 0; x < bgr.cols; ++x) {
      const int opacity = opacities[x];
      for (int channel = 0; channel < 3; ++channel) {
        const int mixed = colours[x][channel] * opacity + backdrop * (255 - opacity);
        colours[x][channel] = static_cast<std::uint8_t>((mixed + 127) / 255);
      }
    }
  }
}

}  // namespace

Picture flatten(const cv::Mat& decoded) {
  Picture picture = blank_picture(decoded.cols, decoded.rows);
  cv::Mat bgr = mat_of(picture);
  if (decoded.channels() == 1) {
    cv::cvtColor(colours_to_8_bit(decoded), bgr, cv::COLOR_GRAY2BGR);
    return picture;
  }
  if (decoded.channels() == 3) {
    colours_to_8_bit(decoded).copyTo(bgr);
    return picture;
  }
  // Colours are separated from alpha first: a full alpha would hide that they are not stretched.
  cv::Mat colours(decoded.size(), CV_MAKETYPE(decoded.depth(), 3));
  cv::Mat alpha(decoded.size(), CV_MAKETYPE(decoded.depth(), 1));
  cv::Mat parts[] = {colours, alpha};
  constexpr int kFromTo[] = {0, 0, 1, 1, 2, 2, 3, 3};
  cv::mixChannels(&decoded, 1, parts, 2, kFromTo, 4);
  colours_to_8_bit(colours).copyTo(bgr);
  if (alpha.depth() != CV_8U) alpha.convertTo(alpha, CV_8U, kOpaque / kFullRange16);
  const double mean = mean_brightness(bgr, alpha);
  lay_over(mean < 127.5 ? 255 : 0, alpha, bgr);
  return picture;
}

int jpeg_orientation(std::span<const std::uint8_t> jpeg) {
  const std::unique_ptr<ExifData, decltype(&exif_data_unref)> data(
      exif_data_new_from_data(jpeg.data(), static_cast<unsigned>(jpeg.size())), &exif_data_unref);
  if (!data) return kUprightOrientation;
  const ExifEntry* entry = exif_content_get_entry(data->ifd[EXIF_IFD_0], EXIF_TAG_ORIENTATION);
  if (!entry || entry->format != EXIF_FORMAT_SHORT || entry->components != 1) {
    return kUprightOrientation;
  }
  const int orientation = exif_get_short(entry->data, exif_data_get_byte_order(data.get()));
  return orientation >= 1 && orientation <= 8 ? orientation : kUprightOrientation;
}

int exif_block_orientation(std::span<const std::uint8_t> block) {
  std::vector<std::uint8_t> with_head = {'E', 'x', 'i', 'f', 0, 0};
  // Some programs write the head into PNG or WebP files anyway.
  if (std::equal(with_head.begin(), with_head.end(), block.begin(),
                 block.begin() + std::min<std::ptrdiff_t>(6, std::ssize(block)))) {
    with_head.clear();
  }
  with_head.insert(with_head.end(), block.begin(), block.end());
  return jpeg_orientation(with_head);
}

Picture turned_upright(Picture picture, int orientation) {
  if (orientation <= kUprightOrientation || orientation > 8) return picture;
  const bool lies_on_its_side = orientation >= 5;
  Picture turned = lies_on_its_side ? blank_picture(picture.height, picture.width)
                                    : blank_picture(picture.width, picture.height);
  const cv::Mat stored = mat_of(picture);
  cv::Mat seen = mat_of(turned);
  constexpr int kUpDown = 0, kLeftRight = 1, kBoth = -1;
  switch (orientation) {
    case 2:
      cv::flip(stored, seen, kLeftRight);
      break;
    case 3:
      cv::flip(stored, seen, kBoth);
      break;
    case 4:
      cv::flip(stored, seen, kUpDown);
      break;
    case 5:
      cv::transpose(stored, seen);
      break;
    case 6:
      cv::rotate(stored, seen, cv::ROTATE_90_CLOCKWISE);
      break;
    case 7:
      cv::transpose(stored, seen);
      cv::flip(seen, seen, kBoth);
      break;
    default:
      cv::rotate(stored, seen, cv::ROTATE_90_COUNTERCLOCKWISE);
      break;
  }
  return turned;
}

}  // namespace repose::vision
