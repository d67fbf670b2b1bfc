#pragma once

#include "cli/common/command.h"

/// Commands on runs that are there: what readings they predict.
namespace repose::cli {

Command predict_command();

}  // namespace repose::cli
