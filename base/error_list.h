#pragma once

#include <stdexcept>
#include <string>

namespace repose::base {

/// Collects what is wrong with a protocol, to tell all of it at once.
class ErrorList {
 public:
  /// Notes `error` unless the rule holds.
  void require(bool holds, const std::string& error) {
    if (!holds) add(error);
  }

  void add(const std::string& error) { text_ += (text_.empty() ? "" : "\n") + error; }

  /// Throws std::invalid_argument with every error, a line each.
  void throw_if_any() const {
    if (!text_.empty()) throw std::invalid_argument(text_);
  }

 private:
  std::string text_;
};

}  // namespace repose::base
