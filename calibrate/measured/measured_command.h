#pragma once

#include <string>

#include "calibrate/measured/measured_file.h"
#include "vision/hints/hint_file.h"
#include "vision/hints/proposal.h"

namespace repose::calibrate {

/// The command line that measures the file with all that was said of it, as a shell takes it.
std::string measure_command(const MeasuredPicture& picture);

/// Where millimetres come from, as options of a command, each with a space before it.
std::string scale_options(const vision::ScaleOptions& scale);

/// For the report, with its command.
report::MeasuredPhotograph photograph_of(const MeasuredPicture& picture);

/// What was said of a picture, with what is proposed for it.
vision::PictureSettings with_proposal(vision::PictureSettings told,
                                      const vision::Proposal& proposal);

}  // namespace repose::calibrate
