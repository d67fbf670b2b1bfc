#pragma once

#include <string>

#include "cli/common/command.h"
#include "cli/common/output.h"

namespace repose::cli {

/// The arguments of `repose verify`, as typed.
struct VerifyArguments {
  std::string json_file;
  std::string engine;  ///< another program to run besides ours; empty: none
};

/// Runs `repose verify`: internal_error if any number is out of tolerance.
ExitCode run_verify(const VerifyArguments& arguments);

Command verify_command();

}  // namespace repose::cli
