#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <system_error>

#include "tests/calibrate/sphere_study.h"
#include "tests/cli/command_test.h"

namespace repose::testing {

/// `repose calibrate` on a study that takes a second.
class CalibrateCommandTest : public CommandTest {
 protected:
  CalibrateCommandTest() : CommandTest({"calibrate"}) {
    folder_.write("study.toml", calibrate::test::kSphereStudy);
  }

  std::size_t files_in(const std::string& name) const {
    std::error_code error;
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path(name), error)) {
      count += entry.path().extension() == ".json" ? 1 : 0;
    }
    return count;
  }
};

}  // namespace repose::testing
