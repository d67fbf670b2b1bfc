#pragma once

#include <string>
#include <vector>

#include "calibrate/experiment/picture_angles.h"
#include "cli/measure/measure_batch.h"

namespace repose::cli {

/// Pictures and films taken as repeats of one experiment: of a film its heap at rest alone.
struct Summary {
  calibrate::PictureMean pictures;
  int not_read = 0;
  int copies = 0;  ///< of pictures that are counted
};

Summary summarise(const std::vector<MeasuredPicture>& pictures);

/// "mean 23.38° sd 0.72° n = 10, ..." and what was flagged or left out.
std::string summary_text(const Summary& summary);

/// The same as a JSON object.
std::string summary_json(const Summary& summary);

}  // namespace repose::cli
