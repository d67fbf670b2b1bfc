#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command bench_command();
Command design_command();
Command regress_command();

}  // namespace repose::cli
