#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vision/camera/board_placing.h"
#include "vision/film/film_file.h"
#include "vision/measure/repose_angle.h"
#include "vision/measure/scale_bar.h"
#include "vision/picture/picture.h"

/// Videos: common parts of all tracked experiments.
namespace repose::vision {

struct TrackOptions {
  std::optional<ScaleBar> scale = {};  ///< in uncorrected frames
  /// A board in the picture, instead of a scale.
  std::optional<BoardPlacing> board = {};
  /// For a roll without a scale: how far up the incline the grain was released.
  std::optional<double> released_mm = {};
  bool draws_strobe = false;
  /// Called periodically with the completed fraction, 0 to 1; may throw to cancel.
  std::function<void(double)> progress = {};
};

/// The centre of the grain in one frame.
struct GrainPlace {
  double time_s = 0;
  Point centre;
};

}  // namespace repose::vision
