#include "vision/film/scene_change.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace repose::vision {

namespace {

constexpr int kShiftWidth_px = 240;
/// Larger differences in grey levels mean that something stands in front of the scene.
constexpr double kOtherThing = 20;

cv::Mat shift_picture(const cv::Mat& frame) {
  const double scale = std::min(1.0, kShiftWidth_px / static_cast<double>(frame.cols));
  cv::Mat small, grey;
  cv::resize(frame, small, {}, scale, scale, cv::INTER_AREA);
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(grey, CV_32F);
  cv::GaussianBlur(grey, grey, {5, 5}, 1);
  return grey;
}

cv::Mat moved_back(const cv::Mat& seen, const cv::Point2d& shift) {
  const cv::Matx23d back(1, 0, shift.x, 0, 1, shift.y);
  cv::Mat moved;
  cv::warpAffine(seen, moved, back, seen.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  return moved;
}

}  // namespace

SceneShift::SceneShift(const cv::Mat& scene, const cv::Mat& counts) : grey_(shift_picture(scene)) {
  cv::Sobel(grey_, across_, CV_32F, 1, 0, 3, 1. / 8);
  cv::Sobel(grey_, down_, CV_32F, 0, 1, 3, 1. / 8);
  if (counts.empty()) {
    counts_ = cv::Mat(grey_.size(), CV_8U, cv::Scalar(255));
  } else {
    cv::resize(counts, counts_, grey_.size(), 0, 0, cv::INTER_NEAREST);
  }
}

cv::Point2d SceneShift::of(const cv::Mat& frame) const {
  constexpr double kMax = .5;  // of the difference may remain
  const cv::Mat seen = shift_picture(frame);
  const cv::Point2d shift = shift_of(seen);
  if (difference_to(moved_back(seen, shift)) > kMax * difference_to(seen)) return {0, 0};
  return shift * (static_cast<double>(frame.cols) / seen.cols);
}

cv::Point2d SceneShift::shift_of(const cv::Mat& seen) const {
  constexpr int kRounds = 10;
  constexpr double kEnough_px = .1;
  cv::Mat now = seen;
  cv::Point2d shift;
  for (int round = 0; round < kRounds; ++round) {
    const cv::Point2d step = step_to(now);
    shift += step;
    // One gradient step finds shifts of about a pixel.
    if (std::hypot(step.x, step.y) < kEnough_px) break;
    now = moved_back(seen, shift);
  }
  return shift;
}

/// Variance of the difference where nothing stands in front of the scene.
double SceneShift::difference_to(const cv::Mat& now) const {
  cv::Mat difference = now - grey_;
  const cv::Mat counts = counts_ & (cv::abs(difference) <= kOtherThing);
  cv::Scalar mean, deviation;
  cv::meanStdDev(difference, mean, deviation, counts);
  return deviation[0] * deviation[0];
}

cv::Point2d SceneShift::step_to(const cv::Mat& now) const {
  // now = gain scene + offset - shift . gradient, where nothing stands in front of the scene.
  cv::Matx44d normal = cv::Matx44d::zeros();
  cv::Vec4d right(0, 0, 0, 0);
  for (int row = 0; row < now.rows; ++row) {
    for (int k = 0; k < now.cols; ++k) {
      if (counts_.at<uchar>(row, k) == 0) continue;
      const double scene = grey_.at<float>(row, k);
      const double difference = now.at<float>(row, k) - scene;
      if (std::abs(difference) > kOtherThing) continue;
      const cv::Vec4d terms(-across_.at<float>(row, k), -down_.at<float>(row, k), scene / 128, 1);
      normal += terms * terms.t();
      right += difference * terms;
    }
  }
  constexpr double kMinGradient = 50;  // of a scene with enough structure
  if (normal(0, 0) < kMinGradient || normal(1, 1) < kMinGradient) return {0, 0};
  for (int k = 0; k < 4; ++k) normal(k, k) += 1e-6;
  const cv::Vec4d solution = normal.solve(right, cv::DECOMP_CHOLESKY);
  return {solution[0], solution[1]};
}

namespace {

constexpr int kLookWidth_px = 160;
constexpr double kBlur_px = .8;
constexpr double kDarkGrey = 8;  ///< grey levels; below it, a ratio means nothing

double middle_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double grey_of(const cv::Vec3f& colour) { return (colour[0] + colour[1] + colour[2]) / 3; }

/// The mode of the ratios, approached from the median, which moving things bias.
double crowd_of(std::vector<double>& ratios) {
  constexpr int kRounds = 3;
  constexpr double kNear = .08;
  double middle = middle_of(ratios);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> near;
    for (const double ratio : ratios) {
      if (std::abs(ratio - middle) < kNear) near.push_back(ratio);
    }
    if (near.empty()) break;
    middle = middle_of(near);
  }
  return middle;
}

/// How much brighter each row has become, from most of its pixels and of neighbouring rows.
std::vector<double> row_gains(const cv::Mat& look, const cv::Mat& earlier) {
  cv::Mat gains(look.rows, 1, CV_64F);
  std::vector<double> ratios(static_cast<std::size_t>(look.cols)), all;
  for (int row = 0; row < look.rows; ++row) {
    for (int k = 0; k < look.cols; ++k) {
      ratios[static_cast<std::size_t>(k)] = (grey_of(look.at<cv::Vec3f>(row, k)) + kDarkGrey) /
                                            (grey_of(earlier.at<cv::Vec3f>(row, k)) + kDarkGrey);
    }
    gains.at<double>(row) = crowd_of(ratios);
    all.push_back(gains.at<double>(row));
  }
  const double whole = middle_of(all);
  constexpr double kFlicker = .15;
  constexpr int kRows = 5;
  gains = cv::max(cv::min(gains, whole * (1 + kFlicker)), whole * (1 - kFlicker));
  cv::blur(gains, gains, {1, kRows}, {-1, -1}, cv::BORDER_REPLICATE);
  return {gains.begin<double>(), gains.end<double>()};
}

/// The further gain of each colour.
std::array<double, 3> colour_gains(const cv::Mat& look, const cv::Mat& earlier,
                                   const std::vector<double>& rows) {
  std::array<double, 3> gains{};
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<double> ratios;
    constexpr int kStep = 3;
    for (int row = 0; row < look.rows; row += kStep) {
      for (int k = 0; k < look.cols; k += kStep) {
        ratios.push_back(
            (look.at<cv::Vec3f>(row, k)[channel] + kDarkGrey) /
            (rows[static_cast<std::size_t>(row)] * earlier.at<cv::Vec3f>(row, k)[channel] +
             kDarkGrey));
      }
    }
    gains[static_cast<std::size_t>(channel)] = crowd_of(ratios);
  }
  return gains;
}

/// For each place, the difference in the colour that differs most, after removing changes of light.
cv::Mat grey_difference(const cv::Mat& look, const cv::Mat& earlier) {
  const std::vector<double> rows = row_gains(look, earlier);
  const std::array<double, 3> colours = colour_gains(look, earlier, rows);
  cv::Mat difference(look.size(), CV_32F);
  for (int row = 0; row < look.rows; ++row) {
    for (int k = 0; k < look.cols; ++k) {
      double most = 0;
      for (int channel = 0; channel < 3; ++channel) {
        const double gain =
            rows[static_cast<std::size_t>(row)] * colours[static_cast<std::size_t>(channel)];
        most = std::max(most, std::abs(look.at<cv::Vec3f>(row, k)[channel] -
                                       gain * earlier.at<cv::Vec3f>(row, k)[channel]));
      }
      difference.at<float>(row, k) = static_cast<float>(most);
    }
  }
  return difference;
}

/// Brightness gradient at each place, or the largest next to it.
cv::Mat steepness_of(const cv::Mat& look) {
  cv::Mat grey, across, down, steepness;
  cv::cvtColor(look, grey, cv::COLOR_BGR2GRAY);
  cv::Sobel(grey, across, CV_32F, 1, 0, 3, 1. / 8);
  cv::Sobel(grey, down, CV_32F, 0, 1, 3, 1. / 8);
  cv::magnitude(across, down, steepness);
  cv::dilate(steepness, steepness, cv::Mat());
  return steepness;
}

double noise_in(const cv::Mat& difference) {
  constexpr double kSigmaPerMedian = 1.4826;
  std::vector<double> values(difference.begin<float>(), difference.end<float>());
  return kSigmaPerMedian * middle_of(values);
}

void drop_single_places(cv::Mat& places) {
  constexpr int kFewest = 5;
  cv::Mat labels, stats, centres;
  const int count = cv::connectedComponentsWithStats(places, labels, stats, centres);
  for (int label = 1; label < count; ++label) {
    if (stats.at<int>(label, cv::CC_STAT_AREA) < kFewest) places.setTo(0, labels == label);
  }
}

/// The line of writing that a region belongs to, other parts of which may change less often; empty
/// if it is too large for writing, or not near the upper or lower edge.
cv::Rect line_around(const cv::Rect& region, const cv::Size& picture) {
  constexpr double kHighest = .14, kWidest = .5, kBand = .22;
  if (region.height > kHighest * picture.height || region.width > kWidest * picture.width) {
    return {};
  }
  const bool is_above = region.br().y < kBand * picture.height;
  if (!is_above && region.y < (1 - kBand) * picture.height) return {};
  const int more = 4 * region.height;
  const cv::Rect line(region.x - more, region.y - 1, region.width + 2 * more, region.height + 2);
  return line & cv::Rect({0, 0}, picture);
}

}  // namespace

cv::Mat reduced_look(const cv::Mat& frame) {
  const double scale = std::min(1.0, kLookWidth_px / static_cast<double>(frame.cols));
  cv::Mat small, look;
  cv::resize(frame, small, {}, scale, scale, cv::INTER_AREA);
  small.convertTo(look, CV_32FC3);
  cv::GaussianBlur(look, look, {3, 3}, kBlur_px);
  return look;
}

cv::Mat changed_places(const cv::Mat& look, const cv::Mat& earlier) {
  constexpr double kClearly = 6, kLeast = 6, kMax = 30;  // times the noise; grey levels
  constexpr double kShiver_px = .3;
  const cv::Mat difference = grey_difference(look, earlier);
  const double allowed = std::clamp(kClearly * noise_in(difference), kLeast, kMax);
  const cv::Mat steep = cv::max(steepness_of(look), steepness_of(earlier));
  cv::Mat places = difference > kShiver_px * steep + allowed;
  drop_single_places(places);
  return places;
}

cv::Mat writing_in(const std::vector<cv::Mat>& samples) {
  if (samples.empty()) return {};
  cv::Mat before = reduced_look(samples.front());
  std::array<cv::Mat, 2> counts;
  for (cv::Mat& count : counts) count = cv::Mat::zeros(before.size(), CV_32S);
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const cv::Mat look = reduced_look(samples[k]);
    cv::Mat around;
    cv::dilate(changed_places(look, before), around, cv::Mat());
    cv::add(counts[2 * k / (samples.size() + 1)], 1, counts[2 * k / (samples.size() + 1)], around);
    before = look;
  }
  constexpr int kOften = 3;
  const cv::Mat often = (counts[0] >= 1) & (counts[1] >= 1) & (counts[0] + counts[1] >= kOften);
  cv::Mat writing = cv::Mat::zeros(before.size(), CV_8U), labels, stats, centres;
  const int count = cv::connectedComponentsWithStats(often, labels, stats, centres);
  for (int label = 1; label < count; ++label) {
    const cv::Rect region(
        stats.at<int>(label, cv::CC_STAT_LEFT), stats.at<int>(label, cv::CC_STAT_TOP),
        stats.at<int>(label, cv::CC_STAT_WIDTH), stats.at<int>(label, cv::CC_STAT_HEIGHT));
    writing(line_around(region, before.size())).setTo(255);
  }
  return writing;
}

}  // namespace repose::vision
