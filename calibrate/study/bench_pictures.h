#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/experiment/picture_set.h"
#include "dem/study/study.h"

/// Photographs and films of the bench's heaps that a study names.
namespace repose::calibrate {

/// What a picture of a bench's heap gave.
struct PictureReading {
  std::filesystem::path file;
  std::string status;  ///< "ok", "flagged" or "refused"; see counts_in_mean
  std::optional<double> angle_deg;
  std::string reason;     ///< why there is none
  double own_deg = 0;     ///< as SetPicture::own_deg
  double camera_deg = 0;  ///< as SetPicture::camera_deg
  std::string heap = {};  ///< as SetPicture::heap
};

/// All of them together.
PictureSet set_of(const std::vector<PictureReading>& pictures);

/// The study with the angles of its heaps as measured values: one for each heap, however many
/// pictures there are of it. What the camera does to all pictures is a part that they share; a
/// single heap's angle is no surer than its own pictures are.
dem::Study with_pictures(dem::Study study, const std::vector<PictureReading>& pictures);

}  // namespace repose::calibrate
