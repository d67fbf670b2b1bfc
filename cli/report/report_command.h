#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command report_command();

}  // namespace repose::cli
