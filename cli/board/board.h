#pragma once

#include <string>

#include "cli/common/command.h"
#include "cli/common/output.h"

namespace repose::cli {

/// The arguments of `repose board`, as typed.
struct BoardArguments {
  std::string out_file;
  std::string paper;
  std::string dpi;
};

/// Runs `repose board`.
ExitCode run_board(const BoardArguments& arguments);

Command board_command();

}  // namespace repose::cli
