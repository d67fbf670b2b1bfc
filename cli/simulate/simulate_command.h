#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command simulate_command();

}  // namespace repose::cli
