#pragma once

namespace repose::base {

/// This program's name and version as written into results: "repose 0.1.0".
extern const char* const kProgram;

}  // namespace repose::base
