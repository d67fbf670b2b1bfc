#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Lines of text. Letters are the code points of UTF-8.

namespace repose::base {

/// Whether a byte of UTF-8 begins a code point rather than continuing one.
constexpr bool starts_a_letter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
}

std::size_t letters(std::string_view text);

/// Whether all bytes are valid UTF-8. File names need not be.
bool is_utf8(std::string_view text);

/// With U+FFFD for each invalid byte: for formats that must be UTF-8.
std::string as_utf8(std::string_view text);

/// The text in lines of at most `max_letters`, broken at blanks. Existing line breaks stay; a
/// longer word stays whole.
std::vector<std::string> wrapped(std::string_view text, std::size_t max_letters);

/// The same with `fits` deciding what fits in a line.
std::vector<std::string> wrapped(std::string_view text,
                                 const std::function<bool(const std::string& line)>& fits);

/// The text for a terminal: control characters, characters that change the writing direction and
/// bytes that are not UTF-8 become "\xNN". Line breaks and tabs stay.
std::string printable(std::string_view text);

/// Removes and returns the text's next word, delimited by blanks and line ends; empty at its end.
std::string_view take_word(std::string_view& text);

/// The word of `known` closest to a mistyped one; empty if none is close.
std::string closest_word(std::string_view mistyped, std::span<const std::string> known);

/// A word of a command line, quoted if a shell would interpret it.
std::string shell_word(std::string_view text);

}  // namespace repose::base
