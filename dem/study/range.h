#pragma once

#include <limits>
#include <string>

namespace repose::dem {

/// Which numbers are allowed.
struct Range {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
  bool excludes_from = false;
  bool excludes_to = false;

  bool contains(double value) const;  ///< never NaN or infinite
  std::string rule() const;           ///< "a number above 0 and at most 100"
};

constexpr Range above(double from, double to = std::numeric_limits<double>::infinity()) {
  return {.from = from, .to = to, .excludes_from = true};
}
constexpr Range from_to(double from, double to) { return {.from = from, .to = to}; }
constexpr Range from_to_below(double from, double to) {
  return {.from = from, .to = to, .excludes_to = true};
}

}  // namespace repose::dem
