#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>

namespace repose::calibrate {

/// Reads a text word by word, separated by blanks and line ends.
class TextScanner {
 public:
  explicit TextScanner(std::string_view text) : text_(text) {}

  std::size_t at() const { return at_; }
  void move_to(std::size_t at) { at_ = at; }
  bool is_at_end() const { return at_ >= text_.size(); }

  /// Empty at the end.
  std::string_view word() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    const std::size_t from = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    return text_.substr(from, at_ - from);
  }

  /// The rest of the line, without its end.
  std::string_view line() {
    const std::size_t end = text_.find('\n', at_);
    std::string_view rest = text_.substr(at_, end == text_.npos ? text_.npos : end - at_);
    at_ = end == text_.npos ? text_.size() : end + 1;
    if (rest.ends_with('\r')) rest.remove_suffix(1);
    return rest;
  }

  /// std::nullopt if the word is not a number. "nan" and "inf" are numbers here: the caller reports
  /// where they occur.
  static std::optional<double> number(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
  }

  template <typename Whole>
  static std::optional<Whole> whole(std::string_view word) {
    Whole value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
  }

 private:
  static bool is_blank(char letter) {
    return letter == ' ' || letter == '\t' || letter == '\n' || letter == '\r';
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace repose::calibrate
