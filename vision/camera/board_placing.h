#pragma once

#include "vision/camera/board.h"

namespace repose::vision {

/// How a person has put up a board.
struct BoardPlacing {
  double square_mm = kBoardSquare_mm;  ///< as printed
  /// How far it stands behind the plane that is measured; says nothing without the lens.
  double board_offset_mm = 0;
};

}  // namespace repose::vision
