#pragma once

#include <string>
#include <vector>

#include "base/input_error.h"
#include "vision/measure/repose_angle.h"

/// Options of all commands that measure pictures.
namespace repose::cli {

/// As typed; an empty text leaves the default.
struct TypedMeasuring {
  const std::string& method;
  const std::string& window;
  const std::string& pitch_deg;
  const std::vector<std::string>& exclude;
  base::FieldNames fields;  ///< for what the measurement advises; lives as long as the program
  const char* exclude_option = "--exclude";
};

/// Adds what is wrong to `errors`, also what the measurement itself refuses.
vision::MeasureOptions read_measuring(const TypedMeasuring& typed,
                                      std::vector<std::string>& errors);

}  // namespace repose::cli
