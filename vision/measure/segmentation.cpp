#include "vision/measure/segmentation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <opencv2/imgproc.hpp>

#include "vision/measure/backdrop.h"

namespace repose::vision {
namespace {

constexpr int kSampleStep = 2;
constexpr double kMinWeight = 1e-3;  // of the evidence within a blur's reach, to average over it

/// Every kSampleStep-th value each way where `where` is set: thousands, enough for a histogram.
std::vector<float> sampled(const cv::Mat1f& values, const cv::Mat1b& where) {
  std::vector<float> samples;
  for (int row = 0; row < values.rows; row += kSampleStep) {
    for (int col = 0; col < values.cols; col += kSampleStep) {
      if (where(row, col) != 0) samples.push_back(values(row, col));
    }
  }
  return samples;
}

float quantile(std::vector<float>& samples, double fraction) {
  const auto at = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(samples.size() - 1));
  std::nth_element(samples.begin(), samples.begin() + at, samples.end());
  return samples[static_cast<std::size_t>(at)];
}

/// The side of the threshold on which most of the backdrop lies is outside.
Segmentation by_threshold(std::string name, const cv::Mat1f& values, double threshold,
                          const cv::Mat1b& backdrop) {
  const int above = cv::countNonZero((values > threshold) & backdrop);
  const double sign = 2 * above > cv::countNonZero(backdrop) ? -1 : 1;
  return {std::move(name), cv::Mat1f((values - threshold) * sign)};
}

/// Average of `sum / weight` under one blur; 0 where there is no weight.
template <class Blur>
cv::Mat1f weighted_average(const cv::Mat1f& values, const cv::Mat1b& valid_mask, Blur blur) {
  if (cv::countNonZero(valid_mask) == static_cast<int>(valid_mask.total())) return blur(values);
  cv::Mat1f inside;
  valid_mask.convertTo(inside, CV_32F, 1 / 255.0);
  const cv::Mat1f weight = blur(inside);
  cv::Mat1f average = blur(values.mul(inside)) / cv::max(weight, kMinWeight);
  values.copyTo(average, weight <= kMinWeight);
  return average;
}

/// The same as `smoothed` for a wide blur, which needs no fine pixels.
cv::Mat1f coarsely_smoothed(const cv::Mat1f& values, const cv::Mat1b& valid_mask, double sigma_px) {
  constexpr double kReduction = 8;
  return weighted_average(values, valid_mask, [&](const cv::Mat1f& sharp) {
    cv::Mat1f small;
    cv::resize(sharp, small, {}, 1 / kReduction, 1 / kReduction, cv::INTER_AREA);
    cv::GaussianBlur(small, small, {}, sigma_px / kReduction);
    cv::Mat1f smooth;
    cv::resize(small, smooth, sharp.size(), 0, 0, cv::INTER_LINEAR);
    return smooth;
  });
}

}  // namespace

cv::Mat1f smoothed(const cv::Mat1f& values, const cv::Mat1b& valid_mask, double sigma_px) {
  return weighted_average(values, valid_mask, [&](const cv::Mat1f& sharp) {
    cv::Mat1f smooth;
    cv::GaussianBlur(sharp, smooth, {}, sigma_px);
    return smooth;
  });
}

cv::Mat1f roughness(const cv::Mat1f& lightness, const cv::Mat1b& valid_mask, double sigma_px) {
  const cv::Mat1f deviation = lightness - smoothed(lightness, valid_mask, sigma_px);
  cv::Mat1f rough;
  cv::sqrt(smoothed(deviation.mul(deviation), valid_mask, sigma_px), rough);
  return rough;
}

double otsu_threshold(const cv::Mat1f& values, const cv::Mat1b& valid_mask) {
  std::vector<float> samples = sampled(values, valid_mask);
  if (samples.empty()) return 0;
  const float low = quantile(samples, 0.001);
  const float high = quantile(samples, 0.999);
  if (high <= low) return high;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(samples.size());
  for (const float value : samples) {
    bytes.push_back(cv::saturate_cast<std::uint8_t>(255 * (value - low) / (high - low)));
  }
  cv::Mat ignored;
  const double level = cv::threshold(bytes, ignored, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  return low + (level + 0.5) / 255 * (high - low);
}

Segmentation grey_otsu(const WorkingPicture& work) {
  cv::Mat1b grey;
  cv::cvtColor(work.bgr, grey, cv::COLOR_BGR2GRAY);
  cv::Mat1f values;
  grey.convertTo(values, CV_32F);
  return by_threshold("otsu grey", values, otsu_threshold(values, work.valid_mask),
                      backdrop_strip(work));
}

std::vector<Segmentation> blind_segmentations(const WorkingPicture& work) {
  std::array<cv::Mat1f, 3> lab;
  cv::split(work.lab, lab.data());
  const cv::Mat1b backdrop = backdrop_strip(work);
  std::vector<Segmentation> found;
  const auto add_otsu = [&](std::string name, const cv::Mat1f& values) {
    found.push_back(
        by_threshold(std::move(name), values, otsu_threshold(values, work.valid_mask), backdrop));
  };
  const auto soft = [&](const cv::Mat1f& values, double sigma_px) {
    return smoothed(values, work.valid_mask, sigma_px);
  };
  add_otsu("otsu lightness", soft(lab[0], 0.8));
  add_otsu("otsu red-green", soft(lab[1], 1.5));
  add_otsu("otsu yellow-blue", soft(lab[2], 1.5));
  add_otsu("backdrop model", soft(backdrop_distance(work), 0.8));
  const cv::Mat1f local_mean = coarsely_smoothed(lab[0], work.valid_mask, work.frame.width / 8.0);
  add_otsu("adaptive lightness", soft(lab[0] - local_mean, 0.8));
  return found;
}

Segmentation two_tone_segmentation(const WorkingPicture& work, const Tones& tones) {
  const cv::Vec3i step = cv::Vec3i(tones[1]) - cv::Vec3i(tones[0]);
  int channel = 0;
  for (const int other : {1, 2}) {
    if (std::abs(step[other]) > std::abs(step[channel])) channel = other;
  }
  cv::Mat values;
  cv::extractChannel(work.bgr, values, channel);
  cv::Mat1f part;  // of a pixel, that has the second colour
  values.convertTo(part, CV_32F, 1.0 / step[channel], -1.0 * tones[0][channel] / step[channel]);
  return by_threshold(kTwoTones, smoothed(part, work.valid_mask, 0.8), 0.5, backdrop_strip(work));
}

Segmentation rough_segmentation(const WorkingPicture& work) {
  cv::Mat1f lightness;
  cv::extractChannel(work.lab, lightness, 0);
  const cv::Mat1f rough = roughness(lightness, work.valid_mask, 3);
  return by_threshold("roughness", rough, otsu_threshold(rough, work.valid_mask),
                      backdrop_strip(work));
}

}  // namespace repose::vision
