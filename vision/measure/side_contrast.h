#pragma once

#include <array>
#include <span>

#include <opencv2/core/mat.hpp>

namespace repose::vision {

/// How different a picture is on both sides of a short line through each pixel, for lines of
/// several slopes: the colour and roughness that differ where one thing ends and another begins,
/// over their scatter.
class SideContrast {
 public:
  static constexpr int kSteepest = 3;  ///< of the slopes, tan of 72 degrees

  /// @param material  lightness, two colours and roughness
  /// @param valid_mask  255 where the picture is evidence
  SideContrast(const cv::Mat4f& material, const cv::Mat1b& valid_mask);

  /// 0 to 1, of the best line that rises by about `rise` pixels a column and has the pixel `row`
  /// of the column just below it. Negative where too little evidence lies beside it.
  /// Of lines of all slopes.
  std::span<const cv::Mat1f> all() const { return contrast_; }

  float at(int row, int col, int rise) const { return of(rise)(row, col); }
  const cv::Mat1f& of(int rise) const {
    const int slope = rise + kSteepest;
    return contrast_[static_cast<std::size_t>(slope)];
  }

 private:
  std::array<cv::Mat1f, 2 * kSteepest + 1> contrast_;
};

/// The contrast that a part of all places stays below, over all slopes.
double usual_contrast(std::span<const cv::Mat1f> contrast, double part);

}  // namespace repose::vision
