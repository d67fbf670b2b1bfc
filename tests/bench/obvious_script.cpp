#include "tests/bench/obvious_script.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace repose::bench {
namespace {

/// Otsu's mask of what differs from the picture's upper corners, where there is never a heap.
cv::Mat foreground(const vision::Picture& picture) {
  auto bytes = picture.bgr;
  const cv::Mat colour(picture.height, picture.width, CV_8UC3, bytes.data());
  cv::Mat grey;
  cv::cvtColor(colour, grey, cv::COLOR_BGR2GRAY);
  cv::Mat mask;
  cv::threshold(grey, mask, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  const int corners = mask.at<std::uint8_t>(0, 0) + mask.at<std::uint8_t>(0, mask.cols - 1);
  if (corners > 255) cv::bitwise_not(mask, mask);
  return mask;
}

cv::Mat largest_blob(const cv::Mat& mask) {
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centers;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centers);
  int largest = 0;
  for (int i = 1; i < count; ++i) {
    const auto area = [&](int label) { return stats.at<int>(label, cv::CC_STAT_AREA); };
    if (largest == 0 || area(i) > area(largest)) largest = i;
  }
  return largest == 0 ? cv::Mat() : cv::Mat(labels == largest);
}

/// Angle of y on x; std::nullopt if there are too few points.
std::optional<double> slope_rad(std::span<const cv::Point2d> points) {
  if (points.size() < 5) return std::nullopt;
  cv::Point2d mean;
  for (const auto& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  double xx = 0;
  double xy = 0;
  for (const auto& p : points) {
    xx += (p.x - mean.x) * (p.x - mean.x);
    xy += (p.x - mean.x) * (p.y - mean.y);
  }
  return std::atan(std::abs(xy / xx));
}

}  // namespace

ScriptAngles obvious_script(const vision::Picture& picture) {
  const cv::Mat blob = largest_blob(foreground(picture));
  if (blob.empty()) return {};
  std::vector<cv::Point2d> profile;  // y downwards
  for (int column = 0; column < blob.cols; ++column) {
    for (int row = 0; row < blob.rows; ++row) {
      if (blob.at<std::uint8_t>(row, column) == 0) continue;
      profile.emplace_back(column, row);
      break;
    }
  }
  const auto [crest, toe] = std::minmax_element(
      profile.begin(), profile.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
  const double height = toe->y - crest->y;
  std::vector<cv::Point2d> left;
  std::vector<cv::Point2d> right;
  for (const auto& p : profile) {
    const double part = (toe->y - p.y) / std::max(height, 1.0);
    if (part < 0.2 || part > 0.8) continue;
    (p.x < crest->x ? left : right).push_back(p);
  }
  return {slope_rad(left), slope_rad(right)};
}

}  // namespace repose::bench
