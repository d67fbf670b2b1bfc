#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vision/repeats.h"
#include "vision/repose_angle.h"

namespace repose::cli {

/// A heap seen from one side.
struct HeapView {
  double azimuth_rad = 0;  ///< as in render/camera.h
  vision::MeasureStatus status = vision::MeasureStatus::refused;
  std::optional<double> angle_rad;
};

/// What pictures of a simulated heap from all around tell.
struct HeapPictures {
  std::vector<HeapView> views;
  std::string overlay_file;  ///< the first view with what was measured; empty: none was asked for
  std::string fault;         ///< why there are no views
};

int count(const HeapPictures& pictures, vision::MeasureStatus status);

/// Mean and scatter of the views that gave a number, flagged ones too: to leave out just the views
/// from which a heap looks hollow or low would move the mean. In degrees; none without a number.
std::optional<vision::Repeats> angle_deg(const HeapPictures& pictures);

}  // namespace repose::cli
