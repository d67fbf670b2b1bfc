#include "base/csv.h"

#include <charconv>
#include <system_error>

#include "base/text.h"

namespace repose::base {

namespace {

bool is_number(std::string_view text) {
  double number = 0;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// Spreadsheets would evaluate such text as a formula.
bool is_formula(std::string_view text) {
  constexpr std::string_view kBegins = "=+-@\t\r";
  return !text.empty() && kBegins.find(text.front()) != kBegins.npos && !is_number(text);
}

}  // namespace

std::string csv_cell(std::string_view text) {
  if (!is_utf8(text)) return csv_cell(as_utf8(text));
  if (is_formula(text)) return csv_cell(std::string(text).insert(0, 1, '\''));
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"') quoted += '"';
    quoted += letter;
  }
  return quoted + '"';
}

std::string csv_row(std::span<const std::string> cells) {
  std::string row;
  for (const std::string& cell : cells) {
    if (&cell != cells.data()) row += ',';
    row += csv_cell(cell);
  }
  return row + '\n';
}

}  // namespace repose::base
