#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command measure_command();

}  // namespace repose::cli
