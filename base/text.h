#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Lines of text. Letters are the code points of UTF-8.

namespace repose::base {

/// Whether a byte of UTF-8 begins a letter rather than continuing one.
constexpr bool starts_a_letter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
}

std::size_t letters(std::string_view text);

/// Whether all bytes are UTF-8. Names of files need not be.
bool is_utf8(std::string_view text);

/// With U+FFFD for each byte that is none: what is in UTF-8 by its format stays so.
std::string as_utf8(std::string_view text);

/// The text in lines of at most `max_letters`, broken at blanks. Its own line breaks stay; a word
/// that is longer alone stays whole.
std::vector<std::string> wrapped(std::string_view text, std::size_t max_letters);

/// The same for another measure of what `fits` in a line.
std::vector<std::string> wrapped(std::string_view text,
                                 const std::function<bool(const std::string& line)>& fits);

/// The text for a terminal: characters that control one, or turn the direction of what follows,
/// and bytes that are no UTF-8 become "\xNN". Line breaks and tabs stay.
std::string printable(std::string_view text);

/// Takes the next word, parted by blanks and line ends, from the text; empty at its end.
std::string_view take_word(std::string_view& text);

/// The word of `known` that is closest to a mistyped one; empty when none is close.
std::string closest_word(std::string_view mistyped, std::span<const std::string> known);

/// A word of a command line: in quotes where a shell would take it for something else.
std::string shell_word(std::string_view text);

}  // namespace repose::base
