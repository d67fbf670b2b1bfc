#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command calibrate_command();

}  // namespace repose::cli
