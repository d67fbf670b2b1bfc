#pragma once

#include <string>

#include "calibrate/experiment/run_folder.h"

/// What a restart file holds beside the state, as JSON in the state's provenance.
namespace repose::calibrate {

std::string restart_text(const std::string& description, const RestartRecord& record);

/// @throws base::InputError  the text is damaged or of a run with another description; says
/// what is wrong.
RestartRecord restart_in(const std::string& text, const std::string& description);

}  // namespace repose::calibrate
