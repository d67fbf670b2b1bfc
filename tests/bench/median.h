#pragma once

#include <algorithm>
#include <vector>

namespace repose::bench {

/// The upper of the two middle values if their number is even.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace repose::bench
