#include "vision/measure/side_contrast.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/measure/band.h"

namespace repose::vision {
namespace {

constexpr std::array kReaches = {4, 12};  // px on either side: fine grains, and lumps
constexpr int kSamples = 4;               // columns on either side of the pixel's own
constexpr double kEnough = 0.25;          // of each side that must be evidence
constexpr double kUnsharp = 4;            // variance that nothing is without, as for step_contrast

constexpr int kSums = 6;  // of four channels, of their squares, and how many
using Sums = cv::Vec<double, kSums>;

/// Sums of the columns from the top down to each row.
class ColumnSums {
 public:
  ColumnSums(const cv::Mat4f& material, const cv::Mat1b& valid_mask)
      : sums_(material.rows + 1, material.cols, Sums()) {
    for (int row = 0; row < material.rows; ++row) {
      for (int col = 0; col < material.cols; ++col) {
        Sums here = sums_(row, col);
        if (valid_mask(row, col) != 0) {
          const cv::Vec4f& value = material(row, col);
          for (int i = 0; i < 4; ++i) here[i] += value[i];
          here[4] += value.dot(value);
          here[5] += 1;
        }
        sums_(row + 1, col) = here;
      }
    }
  }
  int rows() const { return sums_.rows - 1; }
  int cols() const { return sums_.cols; }
  Sums between(int from, int to, int col) const {
    return sums_(std::clamp(to, 0, rows()), col) - sums_(std::clamp(from, 0, rows()), col);
  }

 private:
  cv::Mat_<Sums> sums_;
};

double variance(const Sums& sums) {
  double squares = 0;
  for (int i = 0; i < 4; ++i) squares += sums[i] * sums[i];
  return std::max(0.0, sums[4] / sums[5] - squares / (sums[5] * sums[5]));
}

/// A short line, and how far its sides reach up and down from it.
struct Stroke {
  double slope;
  double step;  ///< columns from one sample to the next
  int depth;    ///< rows

  Stroke(double rise, int reach)
      : slope(rise),
        step(reach / std::hypot(1, rise) / kSamples),
        depth(static_cast<int>(std::lround(reach * std::hypot(1, rise)))) {}

  float contrast(const ColumnSums& sums, int row, int col) const {
    Sums above;
    Sums below;
    for (int k = -kSamples; k <= kSamples; ++k) {
      const int there = col + static_cast<int>(std::lround(k * step));
      if (there < 0 || there >= sums.cols()) continue;
      const int level = row - static_cast<int>(std::lround(k * step * slope));
      above += sums.between(level - depth, level, there);
      below += sums.between(level, level + depth, there);
    }
    const double enough = kEnough * (2 * kSamples + 1) * depth;
    if (above[5] < enough || below[5] < enough) return -1;
    double squares = 0;
    for (int i = 0; i < 4; ++i) {
      const double step_here = above[i] / above[5] - below[i] / below[5];
      squares += step_here * step_here;
    }
    const double scatter = kUnsharp + variance(above) + 0.5 * variance(below);
    return static_cast<float>(saturated(std::sqrt(squares / scatter), 1));
  }
};

/// The mean over the reaches of the contrast beside lines of one slope.
cv::Mat1f contrast_along(double slope, const ColumnSums& sums) {
  cv::Mat1f contrast(sums.rows(), sums.cols(), 0.F);
  for (const int reach : kReaches) {
    const Stroke stroke(slope, reach);
    for (int row = 0; row < contrast.rows; ++row) {
      for (int col = 0; col < contrast.cols; ++col) {
        const float here = stroke.contrast(sums, row, col);
        float& mean = contrast(row, col);
        mean = here < 0 || mean < 0 ? -1 : mean + here / static_cast<float>(kReaches.size());
      }
    }
  }
  return contrast;
}

}  // namespace

SideContrast::SideContrast(const cv::Mat4f& material, const cv::Mat1b& valid_mask) {
  const ColumnSums sums(material, valid_mask);
  for (int rise = -kSteepest; rise <= kSteepest; ++rise) {
    const int slope_index = rise + kSteepest;
    cv::Mat1f& best = contrast_[static_cast<std::size_t>(slope_index)];
    best = contrast_along(rise, sums);
    for (const double slope : {rise - 0.5, rise + 0.5}) {
      if (std::abs(slope) < kSteepest) best = cv::max(best, contrast_along(slope, sums));
    }
  }
}

double usual_contrast(std::span<const cv::Mat1f> contrast, double part) {
  constexpr int kStep = 4;
  std::vector<float> values;
  for (const cv::Mat1f& one : contrast) {
    for (int row = 0; row < one.rows; row += kStep) {
      for (int col = 0; col < one.cols; col += kStep) {
        if (one(row, col) >= 0) values.push_back(one(row, col));
      }
    }
  }
  if (values.empty()) return 1;
  const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace repose::vision
