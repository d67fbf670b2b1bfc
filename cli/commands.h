#pragma once

#include <vector>

#include "cli/common/command.h"

namespace repose::cli {

/// In the order of the program's help.
std::vector<Command> all_commands();

}  // namespace repose::cli
