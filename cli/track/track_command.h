#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command track_command();

}  // namespace repose::cli
