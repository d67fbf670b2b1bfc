#include "calibrate/start/toml_text.h"

#include <cstddef>

#include <fmt/format.h>

#include "base/text.h"

namespace repose::calibrate {

std::string toml_comment(const std::string& text) {
  constexpr std::size_t kLine = 98;
  std::string lines;
  for (const std::string& line : base::wrapped(text, kLine)) lines += "# " + line + '\n';
  return lines;
}

std::string toml_number(double value) {
  std::string text = fmt::format("{:.6g}", value);
  const std::size_t plus = text.find("e+");
  if (plus == std::string::npos) return text;
  return text.substr(0, plus) + 'e' + text.substr(text.find_first_not_of("+0", plus + 1));
}

std::string toml_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter;
  }
  return quoted + '"';
}

}  // namespace repose::calibrate
