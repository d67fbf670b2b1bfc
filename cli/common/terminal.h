#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include "base/text.h"

namespace repose::cli {

bool is_terminal(std::FILE* stream);

/// Columns of the terminal that `stream` is; 80 when it is none.
int columns_of(std::FILE* stream);

/// Colours are for terminals, and not where NO_COLOR is set (https://no-color.org).
bool wants_colour(std::FILE* stream);

using base::letters;
using base::wrapped;

/// The text followed or preceded by blanks to `width` letters.
std::string padded(std::string_view text, std::size_t width);
std::string right_aligned(std::string_view text, std::size_t width);

}  // namespace repose::cli
