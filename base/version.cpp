#include "base/version.h"

namespace repose::base {

const char* const kProgram = "repose " REPOSE_VERSION;

}  // namespace repose::base
