#pragma once

namespace repose::dem {

/// As many grains as one run may have: a hundred times what a bench needs, and what fits into the
/// memory of one machine.
inline constexpr int kMaxGrains = 100'000;

}  // namespace repose::dem
