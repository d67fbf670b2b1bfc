#pragma once

#include <span>
#include <string_view>

namespace repose::calibrate {

/// A column of tables with a row for each measured picture.
struct MeasuredColumn {
  std::string_view name;
  std::string_view unit;  ///< empty: it has none
  std::string_view meaning;
  bool is_text = false;
};

std::span<const MeasuredColumn> measured_columns();

}  // namespace repose::calibrate
