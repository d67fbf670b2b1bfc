#include "cli/common/option_value.h"

#include <algorithm>
#include <cctype>
#include <numbers>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.h"

namespace repose::cli {

namespace {

/// "a", "a or b", "a, b or c".
std::string one_of(const std::vector<std::string>& words) {
  const std::string last = words.size() > 1 ? " or " + words.back() : "";
  const auto end = words.size() > 1 ? words.end() - 1 : words.end();
  return fmt::format("{}{}", fmt::join(words.begin(), end, ", "), last);
}

std::string in_small_letters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

template <typename Number, std::size_t count>
std::optional<std::array<Number, count>> read_list(const OptionText& typed, std::string_view rule,
                                                   std::string_view fix) {
  if (typed.text.empty()) return std::nullopt;
  const auto numbers = numbers_in<Number, count>(typed.text);
  if (!numbers) typed.refuse(rule, fix);
  return numbers;
}

}  // namespace

void OptionText::refuse(std::string_view rule, std::string_view fix) const {
  errors.push_back(fmt::format("{} {}: must be {}. Fix: {}.", option, text, rule, fix));
}

std::optional<double> read_number(const OptionText& typed, std::string_view what,
                                  std::string_view fix) {
  if (typed.text.empty()) return std::nullopt;
  const auto number = parse_number<double>(typed.text);
  if (!number) typed.refuse(what, fix);
  return number;
}

std::optional<double> read_positive(const OptionText& typed, std::string_view what,
                                    std::string_view fix) {
  const std::string rule = fmt::format("{}, more than 0", what);
  const auto number = read_number(typed, rule, fix);
  if (!number || *number > 0) return number;
  typed.refuse(rule, fix);
  return std::nullopt;
}

std::optional<double> read_number_within(const OptionText& typed, double min, double max,
                                         std::string_view fix) {
  const std::string rule = fmt::format("a number from {} to {}", min, max);
  const auto number = read_number(typed, rule, fix);
  if (!number || (*number >= min && *number <= max)) return number;
  typed.refuse(rule, fix);
  return std::nullopt;
}

std::optional<int> read_whole_number(const OptionText& typed, int min, int max,
                                     std::string_view fix) {
  if (typed.text.empty()) return std::nullopt;
  const auto number = parse_number<int>(typed.text);
  if (number && *number >= min && *number <= max) return number;
  typed.refuse(fmt::format("a whole number from {} to {}", min, max), fix);
  return std::nullopt;
}

std::optional<std::uint64_t> read_seed(const OptionText& typed) {
  if (typed.text.empty()) return std::nullopt;
  const auto seed = parse_number<std::uint64_t>(typed.text);
  if (!seed) typed.refuse("a whole number from 0 on", fmt::format("{} 1", typed.option));
  return seed;
}

int read_threads(const OptionText& typed) {
  return read_whole_number(typed, 1, kMaxThreads, "leave it out to use all cores")
      .value_or(available_cores());
}

std::optional<double> read_angle(const OptionText& typed, std::string_view fix) {
  const auto degrees = read_number(typed, "a number of degrees", fix);
  if (!degrees) return std::nullopt;
  return *degrees * std::numbers::pi / 180;
}

std::optional<std::vector<double>> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t comma = text.find(',');
    const auto number = parse_number<double>(text.substr(0, comma));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    if (comma == std::string_view::npos) return numbers;
    text.remove_prefix(comma + 1);
  }
}

std::optional<std::array<double, 2>> read_range(const OptionText& typed, std::string_view fix) {
  return read_list<double, 2>(typed, "two numbers with a comma between them", fix);
}

std::optional<std::array<double, 4>> read_line(const OptionText& typed) {
  return read_list<double, 4>(typed, "four numbers X1,Y1,X2,Y2 in pixels",
                              fmt::format("{} 0,540,1000,545 goes nearly level", typed.option));
}

std::optional<std::array<double, 2>> read_point(const OptionText& typed) {
  return read_list<double, 2>(typed, "two numbers X,Y in pixels",
                              fmt::format("{} 320,240", typed.option));
}

std::optional<std::array<int, 4>> read_box(const OptionText& typed) {
  return read_list<int, 4>(
      typed, "four whole numbers X,Y,W,H in pixels",
      fmt::format("{} 0,0,200,80 is a box of 200 x 80 pixels in the top left corner",
                  typed.option));
}

std::optional<std::array<int, 2>> read_size(const OptionText& typed) {
  return read_list<int, 2>(typed, "width and height in whole pixels, with a comma between them",
                           fmt::format("{} 1920,1080", typed.option));
}

std::optional<std::size_t> read_word(const OptionText& typed,
                                     const std::vector<std::string>& words) {
  if (typed.text.empty()) return std::nullopt;
  const auto found = std::find(words.begin(), words.end(), typed.text);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  const std::string guess = base::closest_word(typed.text, words);
  typed.errors.push_back(fmt::format("{} {}: unknown. {}Fix: {}.", typed.option, typed.text,
                                     guess.empty() ? "" : fmt::format("Did you mean {}? ", guess),
                                     one_of(words)));
  return std::nullopt;
}

std::vector<std::size_t> read_words(const OptionText& typed,
                                    const std::vector<std::string>& words) {
  std::set<std::string> names;
  std::string_view rest = typed.text;
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const std::string& name = *names.emplace(rest.substr(0, comma)).first;
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    const OptionText one{typed.option, name, typed.errors};
    if (name.empty()) one.refuse("names with commas between them", "A,B");
    read_word(one, words);
  }
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (names.contains(words[i])) places.push_back(i);
  }
  return places;
}

std::optional<std::size_t> read_ending(const OptionText& typed,
                                       const std::vector<std::string>& endings) {
  if (typed.text.empty()) return std::nullopt;
  const std::string name = in_small_letters(typed.text);
  const auto found =
      std::find_if(endings.begin(), endings.end(),
                   [&name](const std::string& ending) { return name.ends_with(ending); });
  if (found != endings.end()) return static_cast<std::size_t>(found - endings.begin());
  typed.errors.push_back(fmt::format("{} {}: its ending must say what it is. Fix: {}.",
                                     typed.option, typed.text, one_of(endings)));
  return std::nullopt;
}

}  // namespace repose::cli
