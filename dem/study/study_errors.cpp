#include "dem/study/study_errors.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace repose::dem {

std::string Place::text() const {
  return setting == 0 ? fmt::format("{}:{}:{}", file, line, column)
                      : fmt::format("{}:{}:{}", base::field(file), setting, column);
}

void StudyErrors::add(const Place& place, const std::string& what, const std::string& rule,
                      const std::string& fix) {
  errors_.push_back(
      {place, {.where = place.text(), .value = what, .rule = rule, .fix = fix + '.'}});
}

void StudyErrors::throw_if_any() const {
  std::vector<Error> sorted = errors_;
  const auto order = [](const Error& error) {
    return std::tuple(error.place.setting, error.place.line, error.place.column);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Error& a, const Error& b) { return order(a) < order(b); });
  constexpr std::size_t kMost = 100;  // errors that are listed
  std::vector<base::Fault> faults;
  for (const Error& error : sorted) {
    if (faults.size() < kMost) faults.push_back(error.fault);
  }
  if (sorted.size() > kMost) {
    faults.push_back(
        {.value = fmt::format("and {} more, which are not listed", sorted.size() - kMost),
         .fix = "correct these first."});
  }
  if (!faults.empty()) throw base::InputError(std::move(faults));
}

}  // namespace repose::dem
