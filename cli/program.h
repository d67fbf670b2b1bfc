#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "cli/common/command.h"
#include "cli/common/output.h"

namespace repose::cli {

/// All commands, in the order of the program's help.
std::vector<Command> all_commands();

/// Runs a command's work and prints its exceptions: input errors, a line each, with the options of
/// their fields; all others, including a library's std::invalid_argument, as internal errors.
ExitCode carry_out(const std::function<ExitCode()>& work, const std::string& command,
                   base::FieldNames fields);

/// The whole program, from command line to exit code; called by main().
int run_program(int count, const char* const* words);

}  // namespace repose::cli
