#pragma once

#include <string>

#include "calibrate/measured/measured_file.h"
#include "vision/hints/hint_file.h"
#include "vision/hints/proposal.h"

namespace repose::calibrate {

/// The command line that measures the file with all its settings, quoted for a shell.
std::string measure_command(const MeasuredPicture& picture);

/// The source of millimetres, as command-line options, each with a leading space.
std::string scale_options(const vision::ScaleOptions& scale);

/// For the report, with its command.
report::MeasuredPhotograph photograph_of(const MeasuredPicture& picture);

/// A picture's settings, combined with the proposal for it.
vision::PictureSettings with_proposal(vision::PictureSettings told,
                                      const vision::Proposal& proposal);

}  // namespace repose::calibrate
