#pragma once

#include <exception>
#include <string>

/// What is said where the memory does not suffice: an input too large for the machine, or for the
/// limit that somebody set (`ulimit -v`), is no fault of the program.
namespace repose::base {

/// Also as OpenCV says it.
bool is_out_of_memory(const std::exception& error);

/// "WHAT: there is not enough memory. Fix: FIX, or ...".
std::string no_memory(const std::string& what, const std::string& fix);

}  // namespace repose::base
