#pragma once

#include "vision/camera/board.h"

namespace repose::vision {

/// How the user has set up a board.
struct BoardPlacing {
  double square_mm = kBoardSquare_mm;  ///< as printed
  /// Its distance behind the measured plane; meaningless without a lens.
  double board_offset_mm = 0;
};

}  // namespace repose::vision
