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

/// Films: what all experiments that are tracked have in common.
namespace repose::vision {

struct TrackOptions {
  std::optional<ScaleBar> scale = {};  ///< in the frames as they are
  /// Of a board that stands in the picture, in place of a scale.
  std::optional<BoardPlacing> board = {};
  /// Of a roll without a scale: how far up the incline the grain was let go.
  std::optional<double> released_mm = {};
  bool draws_strobe = false;
  /// UserHints which fraction of the work is done, from 0 to 1; may throw to stop it.
  std::function<void(double)> progress = {};
};

/// The centre of the grain in one frame.
struct GrainPlace {
  double time_s = 0;
  Point centre;
};

}  // namespace repose::vision
