#include "vision/track/blobs.h"

#include <algorithm>
#include <cmath>
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

constexpr double kOtherGrey = 18;  ///< grey levels by which two things differ

/// Mean brightness gradient along a region's border.
double edge_around(const cv::Mat& picture, const cv::Mat& border) {
  cv::Mat grey, across, down, size;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  cv::Sobel(grey, across, CV_32F, 1, 0);
  cv::Sobel(grey, down, CV_32F, 0, 1);
  cv::magnitude(across, down, size);
  return cv::mean(size, border)[0];
}

/// Where the video's beginning and end differ, the one with a much weaker edge around the
/// difference is the scene.
void settle_lasting_things(const cv::Mat& early, const cv::Mat& late, cv::Mat& scene) {
  const cv::Mat differs = greatest_difference(early, late) > kOtherGrey;
  cv::Mat clean, labels, stats, centres;
  const cv::Mat dot = cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3});
  cv::morphologyEx(differs, clean, cv::MORPH_OPEN, dot);
  cv::morphologyEx(clean, clean, cv::MORPH_CLOSE, dot, {-1, -1}, 2);
  const int count = cv::connectedComponentsWithStats(clean, labels, stats, centres);
  constexpr int kMargin_px = 3, kMin_px = 12;
  const cv::Rect whole({0, 0}, scene.size());
  for (int label = 1; label < count; ++label) {
    if (stats.at<int>(label, cv::CC_STAT_AREA) < kMin_px) continue;
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

/// From the median of the frames' differences, which moving objects do not affect.
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

namespace {

constexpr int kReducedSide_px = 960;
constexpr std::size_t kMaxBlobs = 24;

/// Difference in the channel that differs most.
cv::Mat colour_difference(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  cv::Mat greatest(difference.size(), CV_8U);
  for (int row = 0; row < difference.rows; ++row) {
    const auto* from = difference.ptr<cv::Vec3b>(row);
    auto* to = greatest.ptr<uchar>(row);
    for (int k = 0; k < difference.cols; ++k) {
      to[k] = std::max({from[k][0], from[k][1], from[k][2]});
    }
  }
  return greatest;
}

/// The difference that all but a few of a thing's pixels stay below: that of pixels with no
/// background or shadow mixed in.
double full_difference(const cv::Mat& difference, const cv::Mat& mask) {
  std::vector<uchar> values;
  for (int row = 0; row < mask.rows; ++row) {
    for (int k = 0; k < mask.cols; ++k) {
      if (mask.at<uchar>(row, k) != 0) values.push_back(difference.at<uchar>(row, k));
    }
  }
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(93 * values.size() / 100);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Position of a colour between the background's (0) and the thing's own (1); may lie beyond.
double mixed_part(const cv::Vec3b& seen, const cv::Vec3b& background, const cv::Vec3d& thing) {
  const cv::Vec3d step = thing - cv::Vec3d(background);
  const double length = step.dot(step);
  return length > 0 ? (cv::Vec3d(seen) - cv::Vec3d(background)).dot(step) / length : 0;
}

/// Like cover_of(), for places without shadows: above a thing's centre. Its lit side, whose colour
/// is closer to that of a bright backdrop, has full weight.
double lit_cover_of(const cv::Vec3b& seen, const cv::Vec3b& background, const cv::Vec3d& thing) {
  constexpr double kNone = .3, kFull = .6;
  return std::clamp((mixed_part(seen, background, thing) - kNone) / (kFull - kNone), 0.0, 1.0);
}

/// Mean colour of the pixels that show nothing but the thing.
cv::Vec3d own_colour(const cv::Mat& frame, const cv::Mat& difference, const cv::Mat& mask,
                     double full) {
  constexpr double kPure = .75;
  cv::Vec3d sum(0, 0, 0);
  double count = 0;
  for (int row = 0; row < mask.rows; ++row) {
    for (int k = 0; k < mask.cols; ++k) {
      if (mask.at<uchar>(row, k) == 0 || difference.at<uchar>(row, k) < kPure * full) continue;
      sum += cv::Vec3d(frame.at<cv::Vec3b>(row, k));
      count += 1;
    }
  }
  return count > 0 ? sum / count : sum;
}

}  // namespace

double cover_of(const cv::Vec3b& seen, const cv::Vec3b& background, const cv::Vec3d& thing) {
  constexpr double kNone = .5, kFull = .8;
  return std::clamp((mixed_part(seen, background, thing) - kNone) / (kFull - kNone), 0.0, 1.0);
}

int reduction_for(const cv::Size& size) {
  return std::max(1, static_cast<int>(
                         std::lround(std::max(size.width, size.height) / double{kReducedSide_px})));
}

cv::Mat reduced_frame(const cv::Mat& bgr, int reduction) {
  if (reduction == 1) return bgr;
  cv::Mat small;
  cv::resize(bgr, small, bgr.size() / reduction, 0, 0, cv::INTER_AREA);
  return small;
}

BlobFinder::BlobFinder(Background background)
    : background_(std::move(background)),
      reduction_(reduction_for(background_.bgr.size())),
      reduced_(reduced_frame(background_.bgr, reduction_)),
      shift_(reduced_) {}

std::vector<cv::Rect> BlobFinder::rough_places(const cv::Mat& small, cv::Mat& labels,
                                               std::vector<int>& numbers) const {
  cv::Mat difference = colour_difference(small, reduced_);
  cv::GaussianBlur(difference, difference, {3, 3}, 0);
  // In grey levels; video compression leaves smaller differences.
  constexpr double kMinDifference = 12, kSigmas = 5;
  const double least = std::max(kMinDifference, kSigmas * background_.noise);
  const cv::Mat mask = difference > least;
  cv::Mat stats, centres;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centres);
  std::vector<int> order;
  constexpr int kMin_px = 4;
  for (int label = 1; label < count; ++label) {
    if (stats.at<int>(label, cv::CC_STAT_AREA) >= kMin_px) order.push_back(label);
  }
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const int area_a = stats.at<int>(a, cv::CC_STAT_AREA);
    const int area_b = stats.at<int>(b, cv::CC_STAT_AREA);
    return area_a != area_b ? area_a > area_b : a < b;
  });
  if (order.size() > kMaxBlobs) order.resize(kMaxBlobs);
  std::vector<cv::Rect> places;
  for (const int label : order) {
    places.emplace_back(
        stats.at<int>(label, cv::CC_STAT_LEFT), stats.at<int>(label, cv::CC_STAT_TOP),
        stats.at<int>(label, cv::CC_STAT_WIDTH), stats.at<int>(label, cv::CC_STAT_HEIGHT));
  }
  numbers = order;
  return places;
}

Blob BlobFinder::refine(const cv::Mat& frame, const cv::Rect& place, const cv::Mat& mask) const {
  const cv::Mat seen = frame(place), scene = background_.bgr(place);
  const cv::Mat difference = colour_difference(seen, scene);
  Blob blob{.box = place};
  blob.contrast = full_difference(difference, mask);
  blob.colour = own_colour(seen, difference, mask, blob.contrast);
  double x = 0, y = 0;
  for (int row = 0; row < mask.rows; ++row) {
    for (int k = 0; k < mask.cols; ++k) {
      if (mask.at<uchar>(row, k) == 0) continue;
      const double cover =
          cover_of(seen.at<cv::Vec3b>(row, k), scene.at<cv::Vec3b>(row, k), blob.colour);
      if (cover <= 0) continue;
      const cv::Point at(place.x + k, place.y + row);
      x += cover * (at.x + .5);
      y += cover * (at.y + .5);
      blob.area_px += cover;
      if (at.x == 0 || at.y == 0 || at.x == frame.cols - 1 || at.y == frame.rows - 1)
        blob.touches_edge = true;
    }
  }
  if (blob.area_px > 0) blob.centre = {x / blob.area_px, y / blob.area_px};
  blob.crest_px = crest(seen, mask, blob);
  return blob;
}

/// From the covered fraction of the columns near the centre, above the centre's row.
double BlobFinder::crest(const cv::Mat& seen, const cv::Mat& mask, const Blob& blob) const {
  constexpr double kMiddle = .35;  // of half the width
  const double half = std::max(1.0, kMiddle * std::sqrt(blob.area_px / CV_PI));
  const cv::Point2d centre = blob.centre - cv::Point2d(blob.box.tl());
  const int from = std::max(0, cvFloor(centre.x - half));
  const int to = std::min(mask.cols - 1, cvFloor(centre.x + half));
  const int last = std::min(mask.rows - 1, cvFloor(centre.y));
  double height = 0, columns = 0;
  for (int k = from; k <= to; ++k, ++columns) {
    for (int row = 0; row <= last; ++row) {
      if (mask.at<uchar>(row, k) == 0) continue;
      const double part = std::min(1.0, centre.y - row);
      height += part * lit_cover_of(seen.at<cv::Vec3b>(row, k),
                                    background_.bgr(blob.box).at<cv::Vec3b>(row, k), blob.colour);
    }
  }
  return columns > 0 ? blob.centre.y - height / columns : blob.centre.y;
}

Look BlobFinder::look(const cv::Mat& frame) const {
  const cv::Mat small = reduced_frame(frame, reduction_);
  cv::Mat labels;
  std::vector<int> numbers;
  const std::vector<cv::Rect> places = rough_places(small, labels, numbers);
  Look look{.shift = reduction_ * shift_.of(small)};
  std::vector<Blob>& blobs = look.blobs;
  const cv::Rect whole({0, 0}, labels.size());
  const cv::Mat dot = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  for (std::size_t k = 0; k < places.size(); ++k) {
    constexpr int kMargin_px = 2;
    const cv::Rect rough =
        cv::Rect(places[k].x - kMargin_px, places[k].y - kMargin_px,
                 places[k].width + 2 * kMargin_px, places[k].height + 2 * kMargin_px) &
        whole;
    cv::Mat mask = labels(rough) == numbers[k], full;
    cv::dilate(mask, mask, dot, {-1, -1}, kMargin_px);
    cv::Rect place(rough.tl() * reduction_, rough.size() * reduction_);
    if (rough.br().x == labels.cols) place.width = frame.cols - place.x;
    if (rough.br().y == labels.rows) place.height = frame.rows - place.y;
    cv::resize(mask, full, place.size(), 0, 0, cv::INTER_NEAREST);
    Blob blob = refine(frame, place, full);
    if (blob.area_px > 0) blobs.push_back(blob);
  }
  std::sort(blobs.begin(), blobs.end(),
            [](const Blob& a, const Blob& b) { return a.centre.x < b.centre.x; });
  return look;
}

}  // namespace repose::vision
