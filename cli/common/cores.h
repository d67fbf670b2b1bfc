#pragma once

#include <tbb/info.h>

namespace repose::cli {

/// Cores that this process may use: on a cluster fewer than the machine has.
inline int available_cores() { return tbb::info::default_concurrency(); }

}  // namespace repose::cli
