#pragma once

#include <string>
#include <vector>

#include "vision/measure/repose_angle.h"

/// Options of all commands that measure pictures, as typed. Each adds what is wrong to `errors`; an
/// empty text leaves the default.
namespace repose::cli {

using ErrorList = std::vector<std::string>;

void read_method(const std::string& text, vision::MeasureOptions& options, ErrorList& errors);
void read_window(const std::string& text, vision::MeasureOptions& options, ErrorList& errors);
void read_pitch(const std::string& text, vision::MeasureOptions& options, ErrorList& errors);

/// `option` is the name under which the boxes were given.
void read_boxes(const std::string& option, const std::vector<std::string>& texts,
                vision::MeasureOptions& options, ErrorList& errors);

}  // namespace repose::cli
