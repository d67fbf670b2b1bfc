#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command bench_command(CLI::App& app);
Command design_command(CLI::App& app);
Command regress_command(CLI::App& app);

}  // namespace repose::cli
