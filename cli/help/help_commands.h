#pragma once

#include <vector>

#include "cli/common/command.h"

namespace repose::cli {

/// The commands that tell of all others: completion and manual.
std::vector<Command> help_commands(const std::vector<Command>& others);

}  // namespace repose::cli
