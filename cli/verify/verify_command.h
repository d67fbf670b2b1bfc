#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command verify_command();

}  // namespace repose::cli
