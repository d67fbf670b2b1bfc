#pragma once

#include <string>

#include "cli/measure/measured_picture.h"

namespace repose::cli {

/// The command that measures a refused picture with its proposal and with all else that was said of
/// it, as a shell takes it; and what it gives, or that its places are to be corrected.
std::string proposal_text(const MeasuredPicture& picture);

}  // namespace repose::cli
