#include "vision/track/background.h"

#include <algorithm>
#include <span>

#include <opencv2/imgproc.hpp>

#include "vision/measure/line_fit.h"

namespace repose::vision {

cv::Mat greatest_difference(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  std::vector<cv::Mat> channels;
  cv::split(difference, channels);
  return cv::max(cv::max(channels[0], channels[1]), channels[2]);
}

namespace {

constexpr double kOtherGrey = 18;  ///< grey levels between two things

/// Mean step of brightness across a region's border.
double edge_around(const cv::Mat& picture, const cv::Mat& border) {
  cv::Mat grey, across, down, size;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  cv::Sobel(grey, across, CV_32F, 1, 0);
  cv::Sobel(grey, down, CV_32F, 0, 1);
  cv::magnitude(across, down, size);
  return cv::mean(size, border)[0];
}

/// Where the film's beginning and end differ, the one with much less of an edge around it is the
/// scene.
void settle_lasting_things(const cv::Mat& early, const cv::Mat& late, cv::Mat& scene) {
  const cv::Mat differs = greatest_difference(early, late) > kOtherGrey;
  cv::Mat clean, labels, stats, centres;
  const cv::Mat dot = cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3});
  cv::morphologyEx(differs, clean, cv::MORPH_OPEN, dot);
  cv::morphologyEx(clean, clean, cv::MORPH_CLOSE, dot, {-1, -1}, 2);
  const int count = cv::connectedComponentsWithStats(clean, labels, stats, centres);
  constexpr int kMargin_px = 3, kLeast_px = 12;
  const cv::Rect whole({0, 0}, scene.size());
  for (int label = 1; label < count; ++label) {
    if (stats.at<int>(label, cv::CC_STAT_AREA) < kLeast_px) continue;
    const cv::Rect box(stats.at<int>(label, cv::CC_STAT_LEFT) - kMargin_px,
                       stats.at<int>(label, cv::CC_STAT_TOP) - kMargin_px,
                       stats.at<int>(label, cv::CC_STAT_WIDTH) + 2 * kMargin_px,
                       stats.at<int>(label, cv::CC_STAT_HEIGHT) + 2 * kMargin_px);
    const cv::Rect place = box & whole;
    const cv::Mat region = labels(place) == label;
    cv::Mat border, around;
    cv::morphologyEx(region, border, cv::MORPH_GRADIENT, dot);
    cv::dilate(region, around, dot, {-1, -1}, kMargin_px);
    const double early_edge = edge_around(early(place), border);
    const double late_edge = edge_around(late(place), border);
    constexpr double kClearly = 1.5;
    if (late_edge > kClearly * early_edge) early(place).copyTo(scene(place), around);
    if (early_edge > kClearly * late_edge) late(place).copyTo(scene(place), around);
  }
}

/// From the middle of the frames' differences, which what moves does not reach.
double noise_of(const std::vector<cv::Mat>& samples, const cv::Mat& scene) {
  std::vector<int> counts(256);
  std::int64_t total = 0;
  for (const cv::Mat& sample : samples) {
    const cv::Mat difference = greatest_difference(sample, scene);
    for (int row = 0; row < difference.rows; row += 4) {
      for (int column = 0; column < difference.cols; column += 4) {
        ++counts[difference.at<uchar>(row, column)];
        ++total;
      }
    }
  }
  std::int64_t below = 0;
  std::size_t level = 0;
  while (level < 255 && 2 * (below += counts[level]) < total) ++level;
  return kMadToSigma * static_cast<double>(level);
}

}  // namespace

cv::Mat median_of(std::span<const cv::Mat> frames) {
  cv::Mat median(frames.front().size(), frames.front().type());
  const auto bytes = static_cast<std::size_t>(median.cols) * median.elemSize();
  std::vector<uchar> values(frames.size());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  for (int row = 0; row < median.rows; ++row) {
    for (std::size_t k = 0; k < bytes; ++k) {
      for (std::size_t n = 0; n < frames.size(); ++n) values[n] = frames[n].ptr(row)[k];
      std::nth_element(values.begin(), middle, values.end());
      median.ptr(row)[k] = *middle;
    }
  }
  return median;
}

Background background_of(const std::vector<cv::Mat>& samples) {
  const std::span<const cv::Mat> all = samples;
  Background background{.bgr = median_of(all)};
  constexpr std::size_t kFewestParts = 9;
  if (all.size() >= kFewestParts) {
    const std::size_t third = all.size() / 3;
    settle_lasting_things(median_of(all.first(third)), median_of(all.last(third)), background.bgr);
  }
  background.noise = noise_of(samples, background.bgr);
  return background;
}

}  // namespace repose::vision
