#include "vision/measure/backdrop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace repose::vision {
namespace {

/// Fraction of the frame's height, from the top, that is taken for backdrop until proven otherwise.
constexpr double kBackdropFraction = 0.25;

/// The upper corners of a box around a heap, down to half its height: there it is not.
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

constexpr int kModelStep = 4;  // every 4th pixel each way is plenty for 6 terms
constexpr int kModelRounds = 6;
constexpr double kModelInlier = 9;          // squared distance of a pixel that still is backdrop
constexpr double kSmallestDeviation = 0.8;  // of L*a*b*: 8-bit steps alone give .3

/// Least squares over the pixels now believed to be backdrop, a little ridge for a narrow strip.
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

}  // namespace

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

}  // namespace repose::vision
