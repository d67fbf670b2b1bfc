#pragma once

namespace repose::cli {

enum class ExitCode {
  done = 0,
  internal_error = 1,
  bad_input = 2,
  nothing_measurable = 3,
  interrupted = 130,
};

}  // namespace repose::cli
