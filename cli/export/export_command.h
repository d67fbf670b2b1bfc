#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command export_command();

}  // namespace repose::cli
