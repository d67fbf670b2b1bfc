#pragma once

#include <ctime>

namespace repose::bench {

/// What this process has used so far.
inline double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace repose::bench
