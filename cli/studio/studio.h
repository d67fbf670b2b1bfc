#pragma once

#include "cli/common/command.h"

namespace repose::cli {

Command studio_command();

}  // namespace repose::cli
