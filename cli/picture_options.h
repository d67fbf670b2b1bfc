#pragma once

#include <string>
#include <vector>

#include "vision/repose_angle.h"

/// Options of all commands that measure pictures, as typed. Each adds what is wrong to `faults`; an
/// empty text leaves the default.
namespace repose::cli {

using Faults = std::vector<std::string>;

void read_method(const std::string& text, vision::MeasureOptions& options, Faults& faults);
void read_window(const std::string& text, vision::MeasureOptions& options, Faults& faults);
void read_pitch(const std::string& text, vision::MeasureOptions& options, Faults& faults);

/// `option` is the name under which the boxes were given.
void read_boxes(const std::string& option, const std::vector<std::string>& texts,
                vision::MeasureOptions& options, Faults& faults);

}  // namespace repose::cli
