#pragma once

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

namespace repose::base {

/// Collects what is wrong with a protocol, to tell all of it at once.
class ErrorList {
 public:
  /// Of more than `most` errors, those after the first `most` are only counted: a table may have a
  /// million rows with the same fault.
  explicit ErrorList(std::size_t most = std::numeric_limits<std::size_t>::max()) : most_(most) {}

  /// Notes `error` unless the rule holds.
  void require(bool holds, const std::string& error) {
    if (!holds) add(error);
  }

  void add(const std::string& error) {
    if (++count_ <= most_) text_ += (text_.empty() ? "" : "\n") + error;
  }

  /// Notes what the other list has.
  void add(const ErrorList& other) {
    if (!other.text_.empty()) add(other.text());
  }

  /// Throws std::invalid_argument with every error, a line each.
  void throw_if_any() const {
    if (!text_.empty()) throw std::invalid_argument(text());
  }

 private:
  std::string text() const {
    if (count_ <= most_) return text_;
    return text_ + "\nand " + std::to_string(count_ - most_) +
           " more of this kind, which are not listed. Fix: correct these first.";
  }

  std::string text_;
  std::size_t count_ = 0;
  std::size_t most_;
};

}  // namespace repose::base
