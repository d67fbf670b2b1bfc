#include "tests/support/places.h"

namespace repose::testing {

std::filesystem::path program() { return REPOSE_PROGRAM; }
std::filesystem::path source_folder() { return REPOSE_SOURCE_FOLDER; }
std::filesystem::path rooms_file() { return REPOSE_ROOMS; }

}  // namespace repose::testing
