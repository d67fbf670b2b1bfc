#include "base/text.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <sstream>
#include <utility>
#include <vector>

#include <boost/nowide/utf/utf.hpp>
#include <fmt/format.h>

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

namespace {

/// Levenshtein distance: characters to insert, remove or replace.
std::size_t distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);  // from a prefix of `from` to those of `to`
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string closest_word(std::string_view mistyped, std::span<const std::string> known) {
  const std::size_t most = std::max<std::size_t>(1, mistyped.size() / 3);
  std::size_t least = most + 1;
  std::string best;
  for (const std::string& word : known) {
    const std::size_t steps = distance(mistyped, word);
    if (steps >= least) continue;
    least = steps;
    best = word;
  }
  return best;
}

std::string_view take_word(std::string_view& text) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

std::string shell_word(std::string_view text) {
  constexpr std::string_view kHarmless = "/._-+,:=@%";
  const auto is_harmless = [&](unsigned char c) {
    return std::isalnum(c) != 0 || c >= 0x80 ||
           kHarmless.find(static_cast<char>(c)) != kHarmless.npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_harmless)) return std::string(text);
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace repose::base
