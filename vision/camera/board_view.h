#pragma once

#include <functional>
#include <vector>

#include "vision/camera/board_placing.h"
#include "vision/camera/board_pose.h"
#include "vision/camera/heap_view.h"
#include "vision/measure/scale_bar.h"

namespace repose::vision {

/// Half-widths of what a scale allows for beside what the corners tell.
inline constexpr double kPrinted = 0.005;  ///< of a board's printed size
inline constexpr double kNoLens = 0.02;    ///< beside where it was taken, for distortion unknown

/// The upright plane that a board in the picture marks: with how well a person puts up a board. It
/// stands upright within 1 degree, parallel to the plane within 3 degrees, and where it is said to
/// stand within 10 mm.
class BoardView {
 public:
  BoardView(const BoardPose& pose, const BoardPlacing& placing);

  /// What the view is made of, and how.
  const Inputs& inputs() const { return inputs_; }
  HeapView view(const Eigen::VectorXd& values) const;
  HeapView view() const { return view(inputs_.values); }

  /// The pitch is told: the board leans by what it differs.
  void take_pitch(double pitch_rad);

  /// A number of the view with its 95 % half-width.
  Estimate estimate(const std::function<double(const HeapView&)>& number) const;

 private:
  Inputs inputs_;
  double square_mm_ = 0;
};

/// The four corners of the sheet, or of what of it is seen, in the picture [px].
std::vector<Point> sheet_outline(const BoardPose& pose, const std::vector<SeenCorner>& corners);

/// Millimetres per pixel in the view's plane, at a place of the picture and in a direction there.
double mm_per_px_along(const HeapView& view, Point place, Point along);

}  // namespace repose::vision
