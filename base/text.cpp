#include "base/text.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace repose::base {

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
