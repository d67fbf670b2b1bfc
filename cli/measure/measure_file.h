#pragma once

#include <functional>
#include <vector>

#include "cli/measure/measure_options.h"
#include "cli/measure/measured_picture.h"

namespace repose::cli {

/// Measures the plan's picture or film of this place, and draws its overlays.
/// @param progress  told which fraction is done; what it throws, other than what says that a file
///   is wrong, ends the work
/// @returns one, and behind it a film's frames where the plan wants them
std::vector<MeasuredPicture> measure_file(const MeasurePlan& plan, std::size_t index,
                                          const std::function<void(double)>& progress);

}  // namespace repose::cli
