#pragma once

#include <optional>
#include <string_view>

namespace repose::base {

/// Points in one key, a.b.c: no file of ours needs more, and each is a table within a table, which
/// the parser of TOML and all that reads its result walk through by calling themselves.
inline constexpr int kMaxPointsInAKey = 8;

/// The first line of a TOML text with a key of more points than that; none when there is no such
/// key. The text need not be TOML.
std::optional<int> line_of_deep_key(std::string_view text);

}  // namespace repose::base
