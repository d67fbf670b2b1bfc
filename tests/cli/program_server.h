#pragma once

#include <string>
#include <vector>

#include "tests/support/run_program.h"

namespace repose::testing {

/// Keeps a process from which runs of the program are forked, so that its two hundred libraries are
/// loaded once and not for each run. To be called before there are other threads.
void start_program_server();

/// Runs the program as run_program() does, in a process of its own, but without loading it.
Finished run_forked(const TemporaryFolder& folder, const std::vector<std::string>& arguments);

}  // namespace repose::testing
