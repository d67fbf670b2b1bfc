#pragma once

#include <string>
#include <string_view>

namespace repose::base {

/// The text for a terminal: characters that control one, or turn the direction of what follows,
/// and bytes that are no UTF-8 become "\xNN". Line breaks and tabs stay.
std::string printable(std::string_view text);

}  // namespace repose::base
