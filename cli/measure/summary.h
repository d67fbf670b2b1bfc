#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/statistics/summary.h"
#include "cli/measure/measure_batch.h"

namespace repose::cli {

/// Pictures taken as repeats of one experiment. Only those with status ok count.
struct Summary {
  std::optional<calibrate::Summary> angle_rad;  ///< empty when none counts
  int flagged = 0;
  int refused = 0;
  int not_read = 0;
};

Summary summarise(const std::vector<MeasuredPicture>& pictures);

/// "mean 23.38° sd 0.72° n = 10, ..." and what was left out.
std::string summary_text(const Summary& summary);

/// The same as a JSON object.
std::string summary_json(const Summary& summary);

}  // namespace repose::cli
