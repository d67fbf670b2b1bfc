#pragma once

#include <string>

#include "calibrate/experiment/simulated_run.h"

/// A run as its file has it: what was simulated, what that gave, and a fingerprint of both.
namespace repose::calibrate {

struct StoredRun {
  std::string description;  ///< as of description_of
  SimulatedRun run;
};

/// As JSON. The same run gives the same bytes.
std::string text_of(const StoredRun& stored);

/// @throws base::InputError  the text is not as it was written: what is wrong with it.
StoredRun stored_run_in(const std::string& text);

}  // namespace repose::calibrate
