#pragma once

#include "vision/measure/choice.h"

namespace repose::vision {

/// The chain of the published hazelnut study, for comparison: grey picture, Otsu's threshold,
/// largest region with its holes filled, upper edge, ordinary least squares through each side, mean
/// of the two sides' absolute slopes. Angles are against the picture's horizontal; toe and crest
/// are left out only as far as the window does.
Choice read_by_paper(const WorkingPicture& work, const MeasureOptions& options);

}  // namespace repose::vision
