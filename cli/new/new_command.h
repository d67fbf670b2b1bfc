#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command new_command();

}  // namespace repose::cli
