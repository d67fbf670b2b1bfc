#include "vision/measure/segmentation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>

#include "vision/measure/working_picture.h"

namespace repose::vision {

namespace {

/// Fraction of the frame's height, from the top, initially assumed to be backdrop.
constexpr double kBackdropFraction = 0.25;

/// The upper corners of a box around a heap, down to half its height: the heap is not there.
cv::Mat1b backdrop_corners(const WorkingPicture& work) {
  cv::Mat1b corners = cv::Mat1b::zeros(work.valid_mask.size());
  const cv::Rect& frame = work.frame;
  for (const int x : {frame.x, frame.br().x - 1}) {
    const int inwards = x == frame.x ? frame.width / 4 : -frame.width / 4;
    const std::vector<cv::Point> corner = {
        {x, frame.y}, {x + inwards, frame.y}, {x, frame.y + frame.height / 2}};
    cv::fillConvexPoly(corners, corner, 255);
  }
  return corners;
}

/// Terms of a quadratic surface over the frame, positions from -1 to 1.
constexpr int kSurfaceTerms = 6;

std::array<double, kSurfaceTerms> surface_terms(const cv::Rect& frame, int col, int row) {
  const double u = 2.0 * (col - frame.x) / std::max(1, frame.width - 1) - 1;
  const double v = 2.0 * (row - frame.y) / std::max(1, frame.height - 1) - 1;
  return {1, u, v, u * u, u * v, v * v};
}

struct BackdropModel {
  cv::Matx<double, kSurfaceTerms, 3> colour;  ///< L*a*b* as a quadratic surface
  cv::Vec3d deviation;                        ///< standard deviation of each channel around it

  cv::Vec3d distance(const WorkingPicture& work, int row, int col) const {
    const auto terms = surface_terms(work.frame, col, row);
    const cv::Vec3f lab = work.lab(row, col);
    cv::Vec3d away;
    for (int channel = 0; channel < 3; ++channel) {
      double expected = 0;
      for (int i = 0; i < kSurfaceTerms; ++i) expected += terms[i] * colour(i, channel);
      away[channel] = (lab[channel] - expected) / deviation[channel];
    }
    return away;
  }

  /// Squared distances of one row: along it the surface is a parabola in u.
  void distances(const WorkingPicture& work, int row, float* squared) const {
    const double step = 2.0 / std::max(1, work.frame.width - 1);
    const double v = surface_terms(work.frame, work.frame.x, row)[2];
    cv::Vec3f c0;
    cv::Vec3f c1;
    cv::Vec3f c2;
    cv::Vec3f weight;
    for (int k = 0; k < 3; ++k) {
      c0[k] = static_cast<float>(colour(0, k) + colour(2, k) * v + colour(5, k) * v * v);
      c1[k] = static_cast<float>(colour(1, k) + colour(4, k) * v);
      c2[k] = static_cast<float>(colour(3, k));
      weight[k] = static_cast<float>(1 / (deviation[k] * deviation[k]));
    }
    const cv::Vec3f* lab = work.lab[row];
    for (int col = 0; col < work.lab.cols; ++col) {
      const auto u = static_cast<float>((col - work.frame.x) * step - 1);
      float sum = 0;
      for (int k = 0; k < 3; ++k) {
        const float away = lab[col][k] - (c0[k] + u * (c1[k] + u * c2[k]));
        sum += weight[k] * away * away;
      }
      squared[col] = sum;
    }
  }
};

constexpr int kModelStep = 4;  // every 4th pixel in both directions is plenty for 6 terms

constexpr int kModelRounds = 6;

constexpr double kModelInlier = 9;  // squared distance up to which a pixel counts as backdrop

constexpr double kSmallestDeviation = 0.8;  // of L*a*b*: 8-bit steps alone give .3

/// Least squares over the pixels now believed to be backdrop, with a slight ridge for narrow
/// strips.
BackdropModel fit_backdrop(const WorkingPicture& work, const std::vector<cv::Point>& pixels) {
  using Normal = cv::Matx<double, kSurfaceTerms, kSurfaceTerms>;
  Normal normal = Normal::eye() * (1e-3 * static_cast<double>(pixels.size()));
  normal(0, 0) = 0;
  cv::Matx<double, kSurfaceTerms, 3> right = cv::Matx<double, kSurfaceTerms, 3>::zeros();
  for (const cv::Point& at : pixels) {
    const auto terms = surface_terms(work.frame, at.x, at.y);
    const cv::Vec3f lab = work.lab(at);
    for (int i = 0; i < kSurfaceTerms; ++i) {
      for (int j = 0; j < kSurfaceTerms; ++j) normal(i, j) += terms[i] * terms[j];
      for (int channel = 0; channel < 3; ++channel) right(i, channel) += terms[i] * lab[channel];
    }
  }
  BackdropModel model{normal.solve(right, cv::DECOMP_SVD), {1, 1, 1}};
  cv::Vec3d squares;
  for (const cv::Point& at : pixels) {
    const cv::Vec3d away = model.distance(work, at.y, at.x);
    squares += away.mul(away);
  }
  const double n = std::max<double>(1, static_cast<double>(pixels.size()));
  for (int channel = 0; channel < 3; ++channel) {
    model.deviation[channel] = std::max(std::sqrt(squares[channel] / n), kSmallestDeviation);
  }
  return model;
}

/// What is initially assumed to be backdrop (255): the upper part of the frame, or the corners of a
/// box around the heap, corrected by the user's hints.
cv::Mat1b backdrop_strip(const WorkingPicture& work) {
  cv::Mat1b strip = cv::Mat1b::zeros(work.valid_mask.size());
  cv::Rect top = work.frame;
  top.height = std::max(1, static_cast<int>(top.height * kBackdropFraction));
  strip(top).setTo(255);
  if (work.told.has_box) strip = backdrop_corners(work);
  if (!work.told.beside_heap.empty()) strip |= work.told.beside_heap;
  if (!work.told.on_heap.empty()) strip &= ~work.told.on_heap;
  return strip & work.valid_mask;
}

/// ln(1 + d), where d is how many standard deviations a pixel's colour is from the backdrop's. The
/// backdrop is modelled as a smooth surface that starts from the strip and takes in all pixels that
/// agree with it, so a gradient across the picture does no harm.
cv::Mat1f backdrop_distance(const WorkingPicture& work) {
  std::vector<cv::Point> pixels;
  const cv::Mat1b strip = backdrop_strip(work);
  for (int row = 0; row < strip.rows; row += kModelStep) {
    for (int col = 0; col < strip.cols; col += kModelStep) {
      if (strip(row, col) != 0) pixels.emplace_back(col, row);
    }
  }
  BackdropModel model = fit_backdrop(work, pixels);
  for (int round = 1; round < kModelRounds; ++round) {
    const double reach =
        work.frame.y +
        work.frame.height * std::min(1.0, kBackdropFraction + 0.6 * round / (kModelRounds - 1));
    std::vector<cv::Point> agreeing;
    for (int row = work.frame.y; row < reach; row += kModelStep) {
      for (int col = work.frame.x; col < work.frame.br().x; col += kModelStep) {
        if (work.valid_mask(row, col) == 0) continue;
        const cv::Vec3d away = model.distance(work, row, col);
        if (away.dot(away) < kModelInlier) agreeing.emplace_back(col, row);
      }
    }
    if (agreeing.size() < 50) break;
    model = fit_backdrop(work, agreeing);
  }
  cv::Mat1f distance(work.lab.size());
  for (int row = 0; row < distance.rows; ++row) model.distances(work, row, distance[row]);
  cv::sqrt(distance, distance);
  cv::log(distance + 1, distance);
  return distance;
}

constexpr int kSampleStep = 2;
constexpr double kMinWeight = 1e-3;  // valid fraction within a blur's reach needed for an average

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

/// The side of the threshold with most of the backdrop is outside.
Segmentation by_threshold(std::string name, const cv::Mat1f& values, double threshold,
                          const cv::Mat1b& backdrop) {
  const int above = cv::countNonZero((values > threshold) & backdrop);
  const double sign = 2 * above > cv::countNonZero(backdrop) ? -1 : 1;
  return {std::move(name), cv::Mat1f((values - threshold) * sign)};
}

/// Average over the valid pixels under a blur; values stay unchanged if none is within its reach.
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

/// The same as `smoothed` for a wide blur, at reduced resolution.
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

std::vector<Segmentation> unsupervised_segmentations(const WorkingPicture& work) {
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
  cv::Mat1f part;  // of a pixel, covered by the second colour
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
