#include "base/text.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include <boost/nowide/utf/utf.hpp>

namespace repose::base {

std::string as_utf8(std::string_view text) {
  namespace utf = boost::nowide::utf;
  std::string valid;
  for (const char* at = text.begin(); at != text.end();) {
    const char* const begin = at;
    const bool is_letter = utf::is_valid_codepoint(utf::utf_traits<char>::decode(at, text.end()));
    if (!is_letter) at = begin + 1;
    valid += is_letter ? std::string_view(begin, static_cast<std::size_t>(at - begin))
                       : std::string_view("\uFFFD");
  }
  return valid;
}

bool is_utf8(std::string_view text) { return as_utf8(text) == text; }

std::size_t letters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts_a_letter));
}

std::vector<std::string> wrapped(std::string_view text, std::size_t max_letters) {
  return wrapped(text,
                 [max_letters](const std::string& line) { return letters(line) <= max_letters; });
}

std::vector<std::string> wrapped(std::string_view text,
                                 const std::function<bool(const std::string& line)>& fits) {
  std::vector<std::string> lines;
  std::istringstream paragraphs{std::string(text)};
  for (std::string paragraph; std::getline(paragraphs, paragraph);) {
    std::istringstream words(paragraph);
    std::string line;
    for (std::string word; words >> word;) {
      std::string longer = line.empty() ? word : line + ' ' + word;
      if (!line.empty() && !fits(longer)) {
        lines.push_back(std::move(line));
        longer = std::move(word);
      }
      line = std::move(longer);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace repose::base
