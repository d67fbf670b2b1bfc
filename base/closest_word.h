#pragma once

#include <span>
#include <string>
#include <string_view>

namespace repose::base {

/// The word of `known` that is closest to a mistyped one; empty when none is close.
std::string closest_word(std::string_view mistyped, std::span<const std::string> known);

}  // namespace repose::base
