#include "tests/support/heap_texture.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace repose::testing {
namespace {

cv::Mat standardised(const cv::Mat& field) {
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(field, mean, deviation);
  return (field - mean[0]) / std::max(deviation[0], 1e-6);
}

cv::Mat mottle(cv::Size size, double scale_px, Random& random) {
  cv::Mat field = cv::Mat::zeros(size, CV_32F);
  for (const double factor : {1.0, 2.5, 6.0, 15.0}) {
    field += smooth_noise(size, factor * scale_px, factor * scale_px, random);
  }
  return field;
}

/// Interwoven threads of uneven thickness and dye.
cv::Mat weave(cv::Size size, double scale_px, Random& random) {
  const double pitch = 1.6 * scale_px;
  cv::Mat field = 0.5 * smooth_noise(size, 30 * scale_px, scale_px, random) +
                  0.5 * smooth_noise(size, scale_px, 30 * scale_px, random) +
                  0.4 * smooth_noise(size, 8 * scale_px, 8 * scale_px, random);
  for (int row = 0; row < size.height; ++row) {
    const double across = std::sin(CV_PI * row / pitch);
    for (int column = 0; column < size.width; ++column) {
      const double along = std::sin(CV_PI * column / pitch);
      field.at<float>(row, column) += static_cast<float>(1.1 * across * along);
    }
  }
  return field;
}

/// Lengthwise grain lines, bent by low-frequency noise, between boards.
cv::Mat wood(cv::Size size, double scale_px, Random& random) {
  const cv::Mat bend = smooth_noise(size, 60 * scale_px, 25 * scale_px, random);
  cv::Mat field = 0.7 * smooth_noise(size, 40 * scale_px, scale_px, random) +
                  0.4 * smooth_noise(size, 10 * scale_px, 0.7 * scale_px, random);
  const double rings = random.uniform(4, 8) * scale_px;
  const double board = random.uniform(25, 40) * scale_px;
  for (int row = 0; row < size.height; ++row) {
    const bool joint = std::fmod(row, board) < 0.25 * scale_px;
    for (int column = 0; column < size.width; ++column) {
      auto& value = field.at<float>(row, column);
      const double phase = 2 * CV_PI * row / rings + 5 * bend.at<float>(row, column);
      value += static_cast<float>(0.6 * std::sin(phase));
      if (joint) value -= 3;
    }
  }
  return field;
}

}  // namespace

cv::Mat smooth_noise(cv::Size size, double bump_width_px, double bump_height_px, Random& random) {
  const int columns = std::max(3, static_cast<int>(size.width / std::max(1.0, bump_width_px)));
  const int rows = std::max(3, static_cast<int>(size.height / std::max(1.0, bump_height_px)));
  cv::RNG rng(random.seed());
  cv::Mat coarse(rows, columns, CV_32F);
  rng.fill(coarse, cv::RNG::NORMAL, 0, 1);
  cv::Mat field;
  cv::resize(coarse, field, size, 0, 0, cv::INTER_CUBIC);
  return field;
}

cv::Mat texture_field(Texture texture, cv::Size size, double scale_px, Random& random) {
  switch (texture) {
    case Texture::noise:
      return standardised(mottle(size, scale_px, random));
    case Texture::fabric:
      return standardised(weave(size, scale_px, random));
    case Texture::wood:
      return standardised(wood(size, scale_px, random));
    case Texture::none:
      break;
  }
  return cv::Mat::zeros(size, CV_32F);
}

}  // namespace repose::testing
