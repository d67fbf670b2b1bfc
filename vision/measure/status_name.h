#pragma once

#include "vision/measure/repose_angle.h"

/// The words of the JSON and CSV files, which other programs read.
namespace repose::vision {

inline const char* name_of(MeasureStatus status) {
  switch (status) {
    case MeasureStatus::ok:
      return "ok";
    case MeasureStatus::flagged:
      return "flagged";
    case MeasureStatus::refused:
      break;
  }
  return "refused";
}

inline const char* name_of(FlankStatus status) {
  switch (status) {
    case FlankStatus::ok:
      return "ok";
    case FlankStatus::truncated:
      return "truncated";
    case FlankStatus::absent:
      break;
  }
  return "absent";
}

inline const char* name_of(Method method) { return method == Method::paper ? "paper" : "auto"; }

}  // namespace repose::vision
