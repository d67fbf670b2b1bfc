#pragma once

#include <string>
#include <vector>

#include "calibrate/experiment/picture_set.h"
#include "calibrate/measured/measured_file.h"
#include "vision/measure/repose_angle.h"

namespace repose::calibrate {

/// A picture of the set that is far from the others.
struct NamedOutlier {
  std::string file;
  double angle_deg = 0;
  double score = 0;
  bool is_counted = false;
};

/// Pictures and films taken as repeats of one experiment: of a film its heap at rest alone.
struct MeasuredSet {
  PictureSet pictures;
  std::vector<NamedOutlier> outliers;
  int not_read = 0;
  int copies = 0;  ///< of pictures that are counted
  int scans = 0;   ///< among those that are counted
  /// Of the scans in silhouette, as compare and studies take them.
  PictureSet silhouettes = {};
};

MeasuredSet measured_set(const std::vector<MeasuredPicture>& pictures);

/// Warns of each picture that is an outlier among them (set_of_pictures), with the code
/// `outlier`.
void name_outliers(std::vector<MeasuredPicture>& pictures);

/// "mean 23.38° sd 0.72° n = 10, ..." and what was flagged or left out.
std::string text_of_set(const MeasuredSet& summary);

/// The same as a JSON object, with what the angles are by.
std::string set_json(const MeasuredSet& summary, const vision::MeasureOptions& options);

}  // namespace repose::calibrate
