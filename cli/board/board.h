#pragma once

#include <string>

#include "cli/common/exit_code.h"

namespace repose::cli {

/// What `repose board` is asked to do, as typed.
struct BoardArguments {
  std::string out_file;
  std::string paper;
  std::string dpi;
};

/// Carries out `repose board`.
ExitCode run_board(const BoardArguments& arguments);

}  // namespace repose::cli
