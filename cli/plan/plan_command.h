#pragma once

#include "cli/common/command.h"

namespace repose::cli {

/// `repose plan`.
Command plan_command();

}  // namespace repose::cli
