#include "vision/picture/flatten.h"

#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "base/input_error.h"
#include "vision/picture/mat_of_picture.h"

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

/// Mean brightness of a BGR picture, each pixel counted as much as it is opaque.
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
  // The colours are parted from alpha first: a full alpha would hide that they are not stretched.
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

}  // namespace repose::vision
