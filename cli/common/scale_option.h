#pragma once

#include <optional>
#include <string_view>

#include "cli/common/option_value.h"
#include "vision/measure/scale_bar.h"

namespace repose::cli {

/// "X1,Y1,X2,Y2,MM": two points of a picture and their distance.
std::optional<vision::ScaleBar> read_scale_bar(const Typed& typed, std::string_view fix);

}  // namespace repose::cli
