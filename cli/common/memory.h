#pragma once

#include <exception>
#include <string>

/// What is said where the memory does not suffice: an input too large for the machine, or for the
/// limit that somebody set (`ulimit -v`), is no fault of the program.
namespace repose::cli {

/// Memory that was freed stays with the program, where the C library can be told so. Pictures need
/// buffers of a megabyte for a moment: to give each of them back to the system, and to have it
/// cleared anew, takes a fifth of the time of measuring a silhouette.
void keep_freed_memory();

/// Also as OpenCV says it.
bool is_out_of_memory(const std::exception& error);

/// "WHAT: there is not enough memory. Fix: FIX, or ...".
std::string no_memory(const std::string& what, const std::string& fix);

}  // namespace repose::cli
