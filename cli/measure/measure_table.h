#pragma once

#include <string>
#include <vector>

#include "calibrate/measured/measured_file.h"

namespace repose::cli {

struct TableStyle {
  int columns = 80;
  bool has_colour = false;
  bool shows_definitions = false;
};

/// A readable table: a row for each picture, film and frame of a series; below it its warnings, or
/// why it was refused.
std::string measure_table(const std::vector<calibrate::MeasuredPicture>& pictures,
                          const TableStyle& style);

}  // namespace repose::cli
