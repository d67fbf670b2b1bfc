#include "base/printable.h"

#include <boost/nowide/utf/utf.hpp>
#include <fmt/format.h>

namespace repose::base {
namespace {

namespace utf = boost::nowide::utf;

bool controls(utf::code_point letter) {
  if (letter == '\n' || letter == '\t') return false;
  const bool is_control = letter < 0x20 || (letter >= 0x7F && letter < 0xA0);
  const bool turns = letter == 0x061C || letter == 0x200E || letter == 0x200F ||
                     (letter >= 0x202A && letter <= 0x202E) ||
                     (letter >= 0x2066 && letter <= 0x2069);
  return is_control || turns;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  for (const char* at = text.begin(); at != text.end();) {
    const char* const begin = at;
    const utf::code_point letter = utf::utf_traits<char>::decode(at, text.end());
    const bool is_letter = utf::is_valid_codepoint(letter);
    if (!is_letter) at = begin + 1;
    if (is_letter && !controls(letter)) {
      shown.append(begin, at);
    } else {
      for (const char* byte = begin; byte != at; ++byte) {
        shown += fmt::format("\\x{:02X}", static_cast<unsigned char>(*byte));
      }
    }
  }
  return shown;
}

}  // namespace repose::base
