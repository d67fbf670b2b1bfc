#pragma once

#include "cli/common/command.h"

/// Commands on runs that are there: what readings they predict, and which to make next.
namespace repose::cli {

Command predict_command();
Command ask_command();

}  // namespace repose::cli
