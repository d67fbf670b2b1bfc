#pragma once

#include <gmock/gmock.h>

#include "vision/measure/repose_angle.h"

namespace repose::vision {

/// Matches a list of warnings that includes this code.
inline auto has_warning(const char* code) {
  return ::testing::Contains(::testing::Field(&Warning::code, code));
}

}  // namespace repose::vision
