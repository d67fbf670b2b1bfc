#pragma once

#include <string>

#include "cli/common/command.h"
#include "cli/common/output.h"

namespace repose::cli {

/// What `repose verify` is asked to do, as typed.
struct VerifyArguments {
  std::string json_file;
  std::string engine;  ///< another program beside ours; empty: none
};

/// Carries out `repose verify`: internal_error when some number is out of tolerance.
ExitCode run_verify(const VerifyArguments& arguments);

Command verify_command();

}  // namespace repose::cli
