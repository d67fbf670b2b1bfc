#pragma once

#include <string>
#include <vector>

#include "calibrate/experiment/picture_set.h"
#include "cli/measure/measure.h"
#include "vision/measure/repose_angle.h"

namespace repose::cli {

/// A picture of the set that is far from the others.
struct NamedOutlier {
  std::string file;
  double angle_deg = 0;
  double score = 0;
  bool is_counted = false;
};

/// Pictures and films taken as repeats of one experiment: of a film its heap at rest alone.
struct Summary {
  calibrate::PictureSet pictures;
  std::vector<NamedOutlier> outliers;
  int not_read = 0;
  int copies = 0;  ///< of pictures that are counted
  int scans = 0;   ///< among those that are counted
  /// Of the scans in silhouette, as compare and studies take them.
  calibrate::PictureSet silhouettes = {};
};

Summary summarise(const std::vector<MeasuredPicture>& pictures);

/// Warns of each picture that is an outlier among them (calibrate::set_of_pictures), with the code
/// `outlier`.
void name_outliers(std::vector<MeasuredPicture>& pictures);

/// "mean 23.38° sd 0.72° n = 10, ..." and what was flagged or left out.
std::string summary_text(const Summary& summary);

/// The same as a JSON object, with what the angles are by.
std::string summary_json(const Summary& summary, const vision::MeasureOptions& options);

}  // namespace repose::cli
