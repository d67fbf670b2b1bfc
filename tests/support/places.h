#pragma once

#include <filesystem>

/// Where things are in this build. They stand in one source, so that the others compile to the same
/// bytes wherever the project lies.
namespace repose::testing {

std::filesystem::path program();        ///< the command line program
std::filesystem::path source_folder();  ///< the repository's top
std::filesystem::path rooms_file();     ///< what cmake/rooms.cmake wrote

}  // namespace repose::testing
