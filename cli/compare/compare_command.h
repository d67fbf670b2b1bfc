#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command compare_command();

}  // namespace repose::cli
