#pragma once

#include <filesystem>
#include <string>

namespace repose::cli {

/// --group-by-name: pictures that differ in a last number alone are of one heap. "heaps/a" for
/// heaps/a_1.jpg and heaps/a-02.png; of a name without _ or - and digits at its end its own,
/// without the ending.
std::string heap_by_name(const std::filesystem::path& picture);

}  // namespace repose::cli
