#pragma once

#include <span>
#include <string>
#include <string_view>

namespace repose::cli {

/// The word of `known` that is closest to a mistyped one; empty when none is close.
std::string closest(std::string_view mistyped, std::span<const std::string> known);

}  // namespace repose::cli
