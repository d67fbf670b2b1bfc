#pragma once

#include <functional>
#include <vector>

#include "vision/camera/board_placing.h"
#include "vision/camera/board_pose.h"
#include "vision/camera/heap_view.h"
#include "vision/measure/scale_bar.h"

namespace repose::vision {

/// Half-widths of a scale's errors beyond those of the corners.
inline constexpr double kPrinted = 0.005;  ///< of a board's printed size
inline constexpr double kNoLens = 0.02;    ///< relative to the place of the scale, for unknown
                                           ///< distortion

/// The upright plane marked by a board in the picture, including how accurately a board is set up
/// by hand: upright within 1 degree, parallel to the plane within 3 degrees, and within 10 mm of
/// its stated distance.
class BoardView {
 public:
  BoardView(const BoardPose& pose, const BoardPlacing& placing);

  /// The inputs of the view, with their covariance.
  const Inputs& inputs() const { return inputs_; }
  HeapView view(const Eigen::VectorXd& values) const;
  HeapView view() const { return view(inputs_.values); }

  /// Uses a given pitch: the difference is attributed to a leaning board.
  void take_pitch(double pitch_rad);

  /// A value derived from the view, with its 95 % half-width.
  Estimate estimate(const std::function<double(const HeapView&)>& number) const;

 private:
  Inputs inputs_;
  double square_mm_ = 0;
};

/// The four corners of the sheet, or of its visible part, in the picture [px].
std::vector<Point> sheet_outline(const BoardPose& pose, const std::vector<SeenCorner>& corners);

/// Millimetres per pixel in the view's plane, at a place of the picture and in a direction there.
double mm_per_px_along(const HeapView& view, Point place, Point along);

}  // namespace repose::vision
