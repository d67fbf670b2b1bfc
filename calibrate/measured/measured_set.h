#pragma once

#include <string>
#include <vector>

#include "calibrate/experiment/picture_set.h"
#include "calibrate/measured/measured_file.h"
#include "vision/measure/repose_angle.h"

namespace repose::calibrate {

/// A picture of the set that lies far from the others.
struct NamedOutlier {
  std::string file;
  double angle_deg = 0;
  double score = 0;
  bool is_counted = false;
};

/// Pictures and films treated as repeats of one experiment; of a film only its heap at rest.
struct MeasuredSet {
  PictureSet pictures;
  std::vector<NamedOutlier> outliers;
  int not_read = 0;
  int copies = 0;  ///< of counted pictures
  int scans = 0;   ///< among the counted ones
  /// Of the scans' silhouettes, as used in comparisons and studies.
  PictureSet silhouettes = {};
};

MeasuredSet measured_set(const std::vector<MeasuredPicture>& pictures);

/// Adds a warning with the code `outlier` to each picture that is an outlier (set_of_pictures).
void name_outliers(std::vector<MeasuredPicture>& pictures);

/// "mean 23.38° sd 0.72° n = 10, ..." and what was flagged or omitted.
std::string text_of_set(const MeasuredSet& summary);

/// The same as a JSON object, with the definition of the angles.
std::string set_json(const MeasuredSet& summary, const vision::MeasureOptions& options);

}  // namespace repose::calibrate
