#pragma once

#include <cstddef>
#include <mutex>
#include <vector>

#include "cli/common/progress.h"

namespace repose::cli {

/// "simulated 34 % of 3 repeats, 12 s left". Any thread may report.
class RepeatsProgress {
 public:
  explicit RepeatsProgress(std::size_t repeats) : fractions_(repeats, 0) {}

  /// How far one repeat is, 0 to 1.
  void report(std::size_t repeat, double fraction);

 private:
  std::mutex mutex_;
  std::vector<double> fractions_;
  ProgressLine line_;
};

}  // namespace repose::cli
