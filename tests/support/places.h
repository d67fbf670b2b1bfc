#pragma once

#include <filesystem>

/// Paths of this build. Kept in one source file, so that the others compile to the same bytes
/// wherever the project lies.
namespace repose::testing {

std::filesystem::path program();        ///< the command line program
std::filesystem::path source_folder();  ///< the repository's top
std::filesystem::path rooms_file();     ///< the file written by cmake/rooms.cmake

}  // namespace repose::testing
