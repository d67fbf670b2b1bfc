#include "base/toml_nesting.h"

#include <cctype>
#include <cstddef>
#include <string>

namespace repose::base {
namespace {

/// End of the quoted text that begins at `start`: its closing quotation mark, or the end of the
/// line if a single-line text has none.
std::size_t end_of_quoted(std::string_view text, std::size_t start) {
  const char mark = text[start];
  const std::string triple(3, mark);
  const bool is_long = text.substr(start).starts_with(triple);
  std::size_t at = start + (is_long ? 3 : 1);
  for (; at < text.size(); ++at) {
    if (mark == '"' && text[at] == '\\') {
      ++at;
    } else if (is_long ? text.substr(at).starts_with(triple) : text[at] == mark) {
      return at + (is_long ? 2 : 0);
    } else if (!is_long && text[at] == '\n') {
      return at - 1;
    }
  }
  return text.size();
}

/// Part of a key between two dots, or a blank beside one.
bool is_of_key(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '-' ||
         letter == ' ' || letter == '\t';
}

}  // namespace

std::optional<int> line_of_deep_key(std::string_view text) {
  int line = 1, points = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char letter = text[at];
    if (letter == '\n') ++line;
    if (letter == '"' || letter == '\'') {
      const std::size_t end = end_of_quoted(text, at);
      for (; at < end && at + 1 < text.size(); ++at) line += text[at + 1] == '\n' ? 1 : 0;
    } else if (letter == '#') {
      while (at + 1 < text.size() && text[at + 1] != '\n') ++at;
    } else if (letter == '.') {
      if (++points > kMaxPointsInAKey) return line;
    } else if (!is_of_key(letter)) {
      points = 0;
    }
  }
  return std::nullopt;
}

}  // namespace repose::base
