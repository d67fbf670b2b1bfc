#pragma once

#include <string>
#include <utility>

#include "vision/measure/repose_angle.h"

namespace repose::vision {

/// Tells the user something that does not put the number in doubt.
inline void note(ReposeAngle& result, std::string code, std::string message) {
  result.warnings.push_back({std::move(code), std::move(message)});
}

/// Tells the user why a person must look before the number is used.
inline void flag(ReposeAngle& result, std::string code, std::string message) {
  result.status = MeasureStatus::flagged;
  note(result, std::move(code), std::move(message));
}

}  // namespace repose::vision
