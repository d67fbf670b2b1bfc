#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/measure/segmentation.h"
#include "vision/measure/working_picture.h"

namespace repose::vision {

/// How much a picture differs between the two sides of a short line through each pixel, for lines
/// of several slopes: the difference in colour and roughness where one thing ends and another
/// begins, over their scatter.
class SideContrast {
 public:
  static constexpr int kSteepest = 3;  ///< slope, tan of 72 degrees

  /// @param material  lightness, two colours and roughness
  /// @param valid_mask  255 where the picture is valid
  SideContrast(const cv::Mat4f& material, const cv::Mat1b& valid_mask);

  /// The contrasts for all slopes.
  std::span<const cv::Mat1f> all() const { return contrast_; }

  /// 0 to 1, for the best line that rises by about `rise` pixels per column and has the pixel `row`
  /// of the column just below it. Negative if too few valid pixels lie beside it.
  float at(int row, int col, int rise) const { return of(rise)(row, col); }
  const cv::Mat1f& of(int rise) const {
    const int slope = rise + kSteepest;
    return contrast_[static_cast<std::size_t>(slope)];
  }

 private:
  std::array<cv::Mat1f, 2 * kSteepest + 1> contrast_;
};

/// Contrast that a fraction `part` of all places stays below, over all slopes.
double usual_contrast(std::span<const cv::Mat1f> contrast, double part);

/// Rough shape of a heap's side in a box: from its foot on the ground to its top, straight or
/// slightly bowed.
struct RoughFlank {
  double foot = 0;  ///< column
  double top = 0;   ///< column
  double bow = 0;   ///< inward shift at half height / columns between foot and top

  /// Column in which it has the fraction `part`, 0 to 1, of its height.
  double column(double part) const;
  /// Fraction of its height that it has in a column; may exceed 1; below 0 outside the foot.
  double part(double col) const;
};

/// Rough shape of a heap: where to search for its edge.
struct HeapTemplate {
  std::optional<RoughFlank> left;  ///< std::nullopt: the heap leaves the box on this side
  std::optional<RoughFlank> right;
  double height = 0;  ///< rows above the ground

  /// The lower of the two flanks' heights, also above the crest; 0 outside the feet.
  double flank_height(double col) const;
};

/// The heap whose flanks the picture shows best, row by row, over most or all of the box's height.
/// No flanks if there are none.
/// @param ground  row of the ground in each column
HeapTemplate best_template(const SideContrast& contrast, const std::vector<int>& ground);

inline constexpr const char* kTraced = "traced";  ///< name of the segmentation

/// The edge of the heap between a box and a ground line drawn by the user: of all edges that rise
/// from the ground to one crest and fall to it again, the one whose two sides differ most. It does
/// not rely on the backdrop's colour; there may be several. Coarse: see its deviation_px.
Segmentation traced_segmentation(const WorkingPicture& work);

}  // namespace repose::vision
