#pragma once

#include <string>

namespace repose::calibrate {

/// Part of a table that was not used.
struct LeftOut {
  std::string what;  ///< "line 5", "column Run"
  std::string why;   ///< "labelled \"Mean\""
};

}  // namespace repose::calibrate
