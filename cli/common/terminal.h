#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace repose::cli {

bool is_terminal(std::FILE* stream);

/// Columns of the terminal that `stream` is; 80 when it is none.
int columns_of(std::FILE* stream);

/// Colours are for terminals, and not where NO_COLOR is set (https://no-color.org).
bool wants_colour(std::FILE* stream);

/// Letters of a UTF-8 text.
std::size_t letters(std::string_view text);

/// The text followed or preceded by blanks to `width` letters.
std::string padded(std::string_view text, std::size_t width);
std::string right_aligned(std::string_view text, std::size_t width);

/// Lines of at most `most` letters, broken at blanks; the text's own line breaks stay.
std::vector<std::string> wrapped(std::string_view text, std::size_t most);

}  // namespace repose::cli
