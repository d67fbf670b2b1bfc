#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command camera_command();

}  // namespace repose::cli
