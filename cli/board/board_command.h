#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command board_command();

}  // namespace repose::cli
