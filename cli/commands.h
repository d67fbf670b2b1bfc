#pragma once

#include <vector>

#include "cli/common/command.h"

namespace repose::cli {

std::vector<Command> add_commands(CLI::App& app);

}  // namespace repose::cli
