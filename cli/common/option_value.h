#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <tbb/info.h>

/// Options as typed values: one reader for each type. Each returns nothing for an empty text
/// (option not given), and for an invalid one, which adds an error.

namespace repose::cli {

/// Cores available to this process; on a cluster fewer than the machine has.
inline int available_cores() { return tbb::info::default_concurrency(); }

/// The whole text as a finite number, with a decimal point in any locale.
template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stopped_at, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stopped_at != end) return std::nullopt;
  if (!std::isfinite(static_cast<double>(number))) return std::nullopt;
  return number;
}

/// "A,B,C" with exactly `count` numbers.
template <typename Number, std::size_t count>
std::optional<std::array<Number, count>> numbers_in(std::string_view text) {
  std::array<Number, count> numbers{};
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == count)) return std::nullopt;
    const auto number = parse_number<Number>(text.substr(0, comma));
    if (!number) return std::nullopt;
    numbers[i] = *number;
    if (comma != std::string_view::npos) text.remove_prefix(comma + 1);
  }
  return numbers;
}

inline constexpr int kMaxThreads = 1024;

/// What was typed after an option, and where to add errors about it.
struct OptionText {
  const char* option = "";
  const std::string& text;
  std::vector<std::string>& errors;

  /// Adds "OPTION TEXT: must be RULE. Fix: FIX."
  void refuse(std::string_view rule, std::string_view fix) const;
};

std::optional<double> read_number(const OptionText& typed, std::string_view what,
                                  std::string_view fix);

/// Above 0.
std::optional<double> read_positive(const OptionText& typed, std::string_view what,
                                    std::string_view fix);

/// From `min` to `max`, inclusive.
std::optional<double> read_number_within(const OptionText& typed, double min, double max,
                                         std::string_view fix);
std::optional<int> read_whole_number(const OptionText& typed, int min, int max,
                                     std::string_view fix);

/// A seed, 0 or above.
std::optional<std::uint64_t> read_seed(const OptionText& typed);

/// Number of threads; all available cores if nothing was typed.
int read_threads(const OptionText& typed);

/// An angle typed in degrees [rad].
std::optional<double> read_angle(const OptionText& typed, std::string_view fix);

/// "A,B,...": any number of numbers, at least one.
std::optional<std::vector<double>> numbers_in(std::string_view text);

/// "FROM,TO".
std::optional<std::array<double, 2>> read_range(const OptionText& typed, std::string_view fix);

/// "X1,Y1,X2,Y2" or "X,Y": points of a picture in pixels.
std::optional<std::array<double, 4>> read_line(const OptionText& typed);
std::optional<std::array<double, 2>> read_point(const OptionText& typed);

/// "X,Y,W,H" or "W,H" in pixels.
std::optional<std::array<int, 4>> read_box(const OptionText& typed);
std::optional<std::array<int, 2>> read_size(const OptionText& typed);

/// Index of the typed word in `words`.
std::optional<std::size_t> read_word(const OptionText& typed,
                                     const std::vector<std::string>& words);

/// "A,B,...": indices in `words` of the typed ones, each once, in the order of `words`.
std::vector<std::size_t> read_words(const OptionText& typed, const std::vector<std::string>& words);

/// Index in `endings` (".png") of a file name's ending, case-insensitive.
std::optional<std::size_t> read_ending(const OptionText& typed,
                                       const std::vector<std::string>& endings);

/// Maps a typed word, or a file's ending, to its value.
template <typename Value>
using Choices = std::vector<std::pair<std::string, Value>>;

template <typename Value>
std::vector<std::string> words_of(const Choices<Value>& choices) {
  std::vector<std::string> words;
  for (const auto& [word, value] : choices) words.push_back(word);
  return words;
}

template <typename Value>
std::optional<Value> read_choice(const OptionText& typed, const Choices<Value>& choices) {
  const auto found = read_word(typed, words_of(choices));
  return found ? std::optional(choices[*found].second) : std::nullopt;
}

template <typename Value>
std::optional<Value> read_format(const OptionText& typed, const Choices<Value>& choices) {
  const auto found = read_ending(typed, words_of(choices));
  return found ? std::optional(choices[*found].second) : std::nullopt;
}

}  // namespace repose::cli
