#pragma once

#include <stdexcept>
#include <string>

namespace repose::dem {

/// Collects what is wrong with a protocol, to tell all of it at once.
class Faults {
 public:
  /// Notes `fault` unless the rule holds.
  void require(bool holds, const std::string& fault) {
    if (!holds) add(fault);
  }

  void add(const std::string& fault) { text_ += (text_.empty() ? "" : "\n") + fault; }

  /// Throws std::invalid_argument with every fault, a line each.
  void throw_if_any() const {
    if (!text_.empty()) throw std::invalid_argument(text_);
  }

 private:
  std::string text_;
};

}  // namespace repose::dem
