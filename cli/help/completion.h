#pragma once

#include <string>
#include <vector>

#include "cli/common/command.h"

namespace repose::cli {

/// Scripts that let a shell complete commands, options, their values and file names when the
/// tabulator key is pressed. Proved by Completion.* in tests/cli, in the shells themselves.
std::string bash_completion(const std::vector<Command>& commands);
std::string zsh_completion(const std::vector<Command>& commands);

}  // namespace repose::cli
