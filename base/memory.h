#pragma once

#include <exception>
#include <string>

/// Out-of-memory messages: an input too large for the machine, or for a limit such as `ulimit -v`,
/// is not a bug in the program.
namespace repose::base {

/// Also recognises OpenCV's error.
bool is_out_of_memory(const std::exception& error);

/// "WHAT: not enough memory. Fix: FIX, or ...".
std::string no_memory(const std::string& what, const std::string& fix);

}  // namespace repose::base
