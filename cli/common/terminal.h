#pragma once

#include <cstdio>

namespace repose::cli {

bool is_terminal(std::FILE* stream);

/// Columns of the terminal that `stream` is; 80 when it is none.
int columns_of(std::FILE* stream);

/// Colours are for terminals, and not where NO_COLOR is set (https://no-color.org).
bool wants_colour(std::FILE* stream);

}  // namespace repose::cli
