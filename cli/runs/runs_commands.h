#pragma once

#include "cli/common/command.h"

/// Commands on existing runs: which readings they predict, and which runs to make next.
namespace repose::cli {

Command predict_command();
Command ask_command();

}  // namespace repose::cli
