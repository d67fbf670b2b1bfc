#pragma once

namespace repose::cli {

/// The program, from its command line to its exit code: what main() does.
int run_program(int count, const char* const* words);

}  // namespace repose::cli
