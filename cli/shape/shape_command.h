#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command shape_command();

}  // namespace repose::cli
