#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_error.h"
#include "cli/common/option_value.h"
#include "vision/camera/sized_heap.h"
#include "vision/measure/repose_angle.h"
#include "vision/measure/scale_bar.h"

/// Options shared by all commands that measure pictures.

namespace repose::cli {

/// Sources of millimetres, and the lens, as typed.
struct ScaleArguments {
  std::string scale;
  bool finds_board = false;
  std::string square_mm;
  std::string board_behind_mm;
  std::string camera_file;
};

/// "X1,Y1,X2,Y2,MM": two points of a picture and their distance.
std::optional<vision::ScaleBar> read_scale_bar(const OptionText& typed, std::string_view fix);

/// @param scale_fix  an example of --scale
/// @param plane  in which a board stands, such as "the heap's middle"
vision::ScaleOptions read_scale(const ScaleArguments& arguments, std::string_view scale_fix,
                                std::string_view plane, std::vector<std::string>& errors);

/// Options as typed; empty: the default.
struct TypedMeasuring {
  const std::string& method;
  const std::string& window;
  const std::string& definition;
  const std::string& pitch_deg;
  const std::vector<std::string>& exclude;
  base::FieldNames fields;  ///< for the measurement's advice; must outlive the program's run
  const char* exclude_option = "--exclude";
};

/// Adds all errors to `errors`, including options refused by the measurement itself.
vision::MeasureOptions read_measuring(const TypedMeasuring& typed,
                                      std::vector<std::string>& errors);

}  // namespace repose::cli
