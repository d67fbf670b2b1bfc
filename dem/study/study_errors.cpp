#include "dem/study/study_errors.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

namespace repose::dem {

std::string Place::text() const {
  return setting == 0 ? fmt::format("{}:{}:{}", file, line, column)
                      : fmt::format("{}:{}:{}", file, setting, column);
}

void StudyErrors::add(const Place& place, const std::string& what, const std::string& rule,
                      const std::string& fix) {
  errors_.push_back(
      {place, fmt::format("{}: {}. Rule: {}. Fix: {}.", place.text(), what, rule, fix)});
}

void StudyErrors::throw_if_any() const {
  if (errors_.empty()) return;
  std::vector<Error> sorted = errors_;
  const auto order = [](const Error& error) {
    return std::tuple(error.place.setting, error.place.line, error.place.column);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Error& a, const Error& b) { return order(a) < order(b); });
  constexpr std::size_t kMost = 100;  // errors that are listed
  std::string text;
  for (std::size_t k = 0; k < std::min(kMost, sorted.size()); ++k) {
    text += (text.empty() ? "" : "\n") + sorted[k].text;
  }
  if (sorted.size() > kMost) {
    text += fmt::format("\nand {} more, which are not listed. Fix: correct these first.",
                        sorted.size() - kMost);
  }
  throw std::invalid_argument(text);
}

}  // namespace repose::dem
