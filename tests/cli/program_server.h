#pragma once

#include <string>
#include <vector>

#include "tests/support/run_program.h"

namespace repose::testing {

/// Starts a process from which runs of the program are forked, so that its two hundred libraries
/// are loaded once and not for each run. Call it before any other threads exist.
void start_program_server();

/// Runs the program like run_program(), in its own process, but without loading it.
Finished run_forked(const TemporaryFolder& folder, const std::vector<std::string>& arguments);

}  // namespace repose::testing
