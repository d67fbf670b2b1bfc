#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "cli/common/option_names.h"
#include "vision/measure/repose_angle.h"

/// Options of all commands that measure pictures.
namespace repose::cli {

/// As typed; an empty text leaves the default.
struct TypedMeasuring {
  const std::string& method;
  const std::string& window;
  const std::string& pitch_deg;
  const std::vector<std::string>& exclude;
  const char* exclude_option = "--exclude";
};

/// Adds what is wrong to `errors`, also what the measurement itself refuses.
vision::MeasureOptions read_measuring(const TypedMeasuring& typed,
                                      std::vector<std::string>& errors);

/// What a measurement calls these options.
std::array<OptionName, 2> measuring_names(const char* exclude_option);

/// Names them in all that a measurement says.
void name_options(vision::ReposeAngle& angle, std::span<const OptionName> names);

}  // namespace repose::cli
