#pragma once

#include "vision/repose_angle.h"

/// The words of the JSON and CSV files, which other programs read.
namespace repose::cli {

inline const char* name_of(vision::MeasureStatus status) {
  switch (status) {
    case vision::MeasureStatus::ok:
      return "ok";
    case vision::MeasureStatus::flagged:
      return "flagged";
    case vision::MeasureStatus::refused:
      break;
  }
  return "refused";
}

inline const char* name_of(vision::FlankStatus status) {
  switch (status) {
    case vision::FlankStatus::ok:
      return "ok";
    case vision::FlankStatus::truncated:
      return "truncated";
    case vision::FlankStatus::absent:
      break;
  }
  return "absent";
}

inline const char* name_of(vision::Method method) {
  return method == vision::Method::paper ? "paper" : "auto";
}

}  // namespace repose::cli
