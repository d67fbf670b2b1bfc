#include "dem/study/study_faults.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

namespace repose::dem {

std::string Place::text() const {
  return setting == 0 ? fmt::format("{}:{}:{}", file, line, column)
                      : fmt::format("{}:{}:{}", file, setting, column);
}

void StudyFaults::add(const Place& place, const std::string& what, const std::string& rule,
                      const std::string& fix) {
  faults_.push_back(
      {place, fmt::format("{}: {}. Rule: {}. Fix: {}.", place.text(), what, rule, fix)});
}

void StudyFaults::throw_if_any() const {
  if (faults_.empty()) return;
  std::vector<Fault> sorted = faults_;
  const auto order = [](const Fault& fault) {
    return std::tuple(fault.place.setting, fault.place.line, fault.place.column);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Fault& a, const Fault& b) { return order(a) < order(b); });
  std::string text;
  for (const Fault& fault : sorted) text += (text.empty() ? "" : "\n") + fault.text;
  throw std::invalid_argument(text);
}

}  // namespace repose::dem
