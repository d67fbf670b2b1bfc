#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/measure/segmentation.h"
#include "vision/measure/working_picture.h"

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

/// Roughly a heap's side in a box: from its foot on the ground to its top, straight or bowed a
/// little.
struct RoughFlank {
  double foot = 0;  ///< column
  double top = 0;   ///< column
  double bow = 0;   ///< of the columns between: how much farther inwards it is at half height

  /// Column in which it has a part, 0 to 1, of its height.
  double column(double part) const;
  /// Part of its height that it has in a column, also above 1; below 0 beside the foot.
  double part(double col) const;
};

/// Roughly a heap: where its edge is to be sought.
struct HeapTemplate {
  std::optional<RoughFlank> left;  ///< none: the heap leaves the box on this side
  std::optional<RoughFlank> right;
  double height = 0;  ///< rows above the ground

  /// Height of the lower of both flanks, also above the crest; 0 beside the feet.
  double flank_height(double col) const;
};

/// Of all such heaps the one whose flanks the picture shows best, row by row, over the whole
/// height of the box. No flanks where there are none.
/// @param ground  row of the ground in each column
HeapTemplate best_template(const SideContrast& contrast, const std::vector<int>& ground);

inline constexpr const char* kTraced = "traced";  ///< name of the segmentation

/// The edge of the heap between a box and a ground line that a person has drawn: of all edges that
/// rise from the ground to one crest and fall to it again, the one along which the picture differs
/// most on both sides. It needs no colour of a backdrop, of which there may be many. Coarse: learn
/// from its result.
Segmentation traced_segmentation(const WorkingPicture& work);

}  // namespace repose::vision
