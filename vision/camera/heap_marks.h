#pragma once

#include <optional>

#include "vision/camera/heap_view.h"
#include "vision/measure/repose_angle.h"
#include "vision/measure/scale_bar.h"

/// The places of a picture that a heap's sizes follow from, and how well they are known.
namespace repose::vision {

/// The places that a size follows from [px].
struct Marks {
  std::optional<Point> left_foot;
  std::optional<Point> right_foot;
  Point crest;
  Point below_crest;  ///< on the ground line
};

/// Of a heap with a ground line and a crest.
Marks marks_of(const ReposeAngle& measured);

/// How high the outline's ends lie above the ground line: a round base is widest where its middle
/// is, and the lowest grains stick out farthest half of their size above the ground [px].
std::optional<double> rise_of_feet(const ReposeAngle& measured, const Marks& marks);

/// Inputs and one more: its number, and room for it.
Eigen::Index added(Inputs& inputs, double value, double deviation);

/// How far each mark is off, as inputs.
class MarkInputs {
 public:
  /// Adds them, with the deviations that segmentations leave.
  /// @param working_px  see working_pixel()
  MarkInputs(Inputs& inputs, const ReposeAngle& measured, double working_px);

  /// The marks as the inputs' values have them.
  Marks applied(const Marks& marks, const Eigen::VectorXd& values) const;

 private:
  Eigen::Index left_ = 0, right_ = 0, crest_ = 0, ground_ = 0;
};

/// Where the ground line touches the base: what is usual, and what the outline's ends say, each
/// with the weight of its variance.
/// @param rim_px  how much lower than the axis the nearest rim stands in the picture
Estimate front_part_of(const ReposeAngle& measured, const Marks& marks, double rim_px,
                       double working_px);

}  // namespace repose::vision
