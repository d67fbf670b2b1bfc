#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "cli/common/exit_code.h"

namespace repose::cli {

/// What the command line comes down to: one of these.
struct Arguments {
  std::function<ExitCode()> run;  ///< carries out the command that was asked for
  base::FieldNames fields;        ///< of this command
  std::string text;               ///< asked for: help or version
  std::string error;              ///< why it is no command line, and how to mend it
};

Arguments parse_arguments(int count, const char* const* words);

}  // namespace repose::cli
