#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "cli/common/command.h"
#include "cli/common/output.h"

namespace repose::cli {

/// In the order of the program's help.
std::vector<Command> all_commands();

/// Does a command's work, and says what it throws: an input's faults, a line each, with the options
/// of their fields; all else, a library's std::invalid_argument too, as an internal error.
ExitCode carry_out(const std::function<ExitCode()>& work, const std::string& command,
                   base::FieldNames fields);

/// The program, from its command line to its exit code: what main() does.
int run_program(int count, const char* const* words);

}  // namespace repose::cli
