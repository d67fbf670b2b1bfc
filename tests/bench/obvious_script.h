#pragma once

#include <optional>

#include "vision/picture/picture.h"

namespace repose::bench {

struct ScriptAngles {
  std::optional<double> left_rad;
  std::optional<double> right_rad;
};

/// What a laboratory would write in an afternoon, as a baseline: greyscale, Otsu's threshold,
/// largest blob, its first pixel in every column, least squares over 20 to 80 % of the height.
ScriptAngles obvious_script(const vision::Picture& picture);

}  // namespace repose::bench
