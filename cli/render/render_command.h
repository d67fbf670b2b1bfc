#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command render_command();

}  // namespace repose::cli
