#pragma once

#include <optional>
#include <string_view>

namespace repose::base {

/// Dots in one key, a.b.c: none of our files needs more, and each is a nested table, which the TOML
/// parser and everything that reads its result process recursively.
inline constexpr int kMaxPointsInAKey = 8;

/// The first line of a TOML text that has a key with more dots than that; std::nullopt if there is
/// none. The text need not be valid TOML.
std::optional<int> line_of_deep_key(std::string_view text);

}  // namespace repose::base
