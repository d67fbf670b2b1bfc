#pragma once

#include <string>

#include "calibrate/statistics/design/design.h"

namespace repose::cli {

struct DesignCsvOptions {
  bool with_coded = false;     ///< a column NAME_coded for each factor
  bool with_standard = false;  ///< the place in standard order, beside the place in the table
};

/// A row for each run: its number, its kind of point, each factor's natural level.
std::string design_csv(const calibrate::Design& design, const DesignCsvOptions& options);

}  // namespace repose::cli
