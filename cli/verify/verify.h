#pragma once

#include <string>

#include "cli/common/exit_code.h"

namespace repose::cli {

/// What `repose verify` is asked to do, as typed.
struct VerifyArguments {
  std::string json_file;
};

/// Carries out `repose verify`: internal_error when some number is out of tolerance.
ExitCode run_verify(const VerifyArguments& arguments);

}  // namespace repose::cli
