#pragma once

#include <optional>
#include <span>

#include "calibrate/statistics/summary.h"
#include "vision/measure/repose_angle.h"

/// The angle of one heap that was drawn from several sides, each view measured like a photograph:
/// particles of any program, three-dimensional scans.

namespace repose::calibrate {

/// The mean of the views that have an angle. The half-width of its 95 % interval is the root of the
/// sum of squares of Student's of the views' mean and of the median of the views' own, which all
/// views may have in common. Refused where fewer than half of the views give an angle; flagged
/// where half of those that do are, or where the interval is wider than 5 degrees.
/// @param views  at least one
vision::ReposeAngle mean_of_views(std::span<const vision::ReposeAngle> views);

/// Standard deviation of the views' angles, rad; none of fewer than two.
std::optional<double> sd_between_views(std::span<const vision::ReposeAngle> views);

/// Mean and scatter of another number, over the views that have an angle; none of none.
std::optional<Summary> summary_of_views(std::span<const vision::ReposeAngle> views,
                                        std::optional<double> vision::ReposeAngle::*number);

}  // namespace repose::calibrate
