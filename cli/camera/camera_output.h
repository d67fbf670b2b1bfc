#pragma once

#include <string>
#include <vector>

#include "vision/camera/lens_fit.h"

namespace repose::cli {

/// A lens with the names of the pictures that it was fitted to.
struct CameraResult {
  std::vector<std::string> files;
  vision::LensFit fit;
  double square_mm = 0;
};

/// Origin of the lens for the camera file: "10 pictures, 0.21 px from the fit".
std::string origin_of(const CameraResult& result);

/// A row for each picture and for each number of the lens; and why it was refused.
std::string camera_table(const CameraResult& result, int terminal_columns);

/// One object. Missing numbers are null.
std::string camera_json(const CameraResult& result);

}  // namespace repose::cli
