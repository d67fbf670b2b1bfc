#include "vision/track/standing_things.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "vision/track/background.h"

namespace repose::vision {
namespace {

/// The backdrop as if nothing stood before it: along each row the median of its surroundings, which
/// reach farther than grains do.
cv::Mat backdrop_of(const cv::Mat& strip) {
  constexpr int kStep_px = 8;
  const int reach = std::max(1, strip.cols / 4);
  const int columns = strip.cols / kStep_px + 1;
  cv::Mat coarse(strip.rows, columns, CV_8UC3);
  std::vector<uchar> values;
  for (int y = 0; y < strip.rows; ++y) {
    for (int k = 0; k < columns; ++k) {
      const int from = std::max(0, k * kStep_px - reach);
      const int to = std::min(strip.cols, k * kStep_px + reach + 1);
      for (int channel = 0; channel < 3; ++channel) {
        values.clear();
        for (int x = from; x < to; ++x) values.push_back(strip.at<cv::Vec3b>(y, x)[channel]);
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        coarse.at<cv::Vec3b>(y, k)[channel] = *middle;
      }
    }
  }
  cv::Mat backdrop;
  cv::resize(coarse, backdrop, strip.size(), 0, 0, cv::INTER_LINEAR);
  return backdrop;
}

OnPlate thing_of(const cv::Mat& mask, const cv::Rect& box) {
  OnPlate thing{.mask = mask};
  const cv::Moments moments = cv::moments(mask, true);
  thing.centre = {moments.m10 / moments.m00, moments.m01 / moments.m00};
  thing.width_px = box.width;
  thing.height_px = box.height;
  const double half_sum = .5 * (moments.mu20 + moments.mu02);
  const double spread = std::hypot(.5 * (moments.mu20 - moments.mu02), moments.mu11);
  thing.elongation = std::sqrt((half_sum + spread) / std::max(1e-9, half_sum - spread));
  thing.touches_edge = box.x <= 1 || box.br().x >= mask.cols - 1 || box.y <= 1;
  return thing;
}

}  // namespace

std::vector<OnPlate> standing_things(const cv::Mat& strip) {
  constexpr double kLeastDifference = 22, kPartOfMost = .35, kLongest = .5;
  constexpr int kLeast_px = 4, kGap_px = 3;
  constexpr std::size_t kMost = 8;
  cv::Mat difference = greatest_difference(strip, backdrop_of(strip));
  cv::GaussianBlur(difference, difference, {3, 3}, 0);
  double most = 0;
  cv::minMaxLoc(difference, nullptr, &most);
  const cv::Mat differs = difference > std::max(kLeastDifference, kPartOfMost * most);
  cv::Mat labels, stats, centres;
  const int count = cv::connectedComponentsWithStats(differs, labels, stats, centres);
  std::vector<std::pair<int, OnPlate>> things;
  for (int label = 1; label < count; ++label) {
    const cv::Rect box(
        stats.at<int>(label, cv::CC_STAT_LEFT), stats.at<int>(label, cv::CC_STAT_TOP),
        stats.at<int>(label, cv::CC_STAT_WIDTH), stats.at<int>(label, cv::CC_STAT_HEIGHT));
    if (box.width < kLeast_px || box.height < kLeast_px || box.width > kLongest * strip.cols ||
        box.br().y < strip.rows - kGap_px)
      continue;
    things.emplace_back(stats.at<int>(label, cv::CC_STAT_AREA), thing_of(labels == label, box));
  }
  std::stable_sort(things.begin(), things.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<OnPlate> largest;
  for (auto& [area, thing] : things) {
    if (largest.size() < kMost) largest.push_back(std::move(thing));
  }
  return largest;
}

}  // namespace repose::vision
