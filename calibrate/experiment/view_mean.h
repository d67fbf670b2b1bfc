#pragma once

#include <optional>
#include <span>

#include "calibrate/statistics/summary.h"
#include "vision/measure/repose_angle.h"

/// The angle of one heap drawn from several directions, each view measured like a photograph:
/// particles of any program, three-dimensional scans.

namespace repose::calibrate {

/// The mean of the views that have an angle. The half-width of its 95 % interval is the root sum of
/// squares of the Student-t half-width of the views' mean and the median of the views' own
/// half-widths, which all views may have in common. Refused if fewer than half of the views give an
/// angle; flagged if half of those that do are flagged, or if the interval is wider than 5 degrees.
/// @param views  at least one
vision::ReposeAngle mean_of_views(std::span<const vision::ReposeAngle> views);

/// Standard deviation of the views' angles, rad; std::nullopt for fewer than two.
std::optional<double> sd_between_views(std::span<const vision::ReposeAngle> views);

/// Mean and scatter of another number, over the views that have an angle; std::nullopt if none has.
std::optional<Summary> summary_of_views(std::span<const vision::ReposeAngle> views,
                                        std::optional<double> vision::ReposeAngle::*number);

}  // namespace repose::calibrate
