#pragma once

#include "cli/common/table.h"
#include "vision/measure/repose_angle.h"

namespace repose::cli {

inline Colour colour_of(vision::MeasureStatus status) {
  switch (status) {
    case vision::MeasureStatus::ok:
      return Colour::green;
    case vision::MeasureStatus::flagged:
      return Colour::yellow;
    case vision::MeasureStatus::refused:
      break;
  }
  return Colour::red;
}

}  // namespace repose::cli
