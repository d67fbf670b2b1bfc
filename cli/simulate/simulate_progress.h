#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <vector>

namespace repose::cli {

/// "simulated 34 % of 3 repeats, 12 s left" on standard error, only when that is a terminal. The
/// line goes away with the object. May be told from any thread.
class FractionProgress {
 public:
  explicit FractionProgress(std::size_t repeats);
  ~FractionProgress();
  FractionProgress(const FractionProgress&) = delete;
  FractionProgress& operator=(const FractionProgress&) = delete;
  FractionProgress(FractionProgress&&) = delete;
  FractionProgress& operator=(FractionProgress&&) = delete;

  /// How far one repeat is, 0 to 1.
  void tell(std::size_t repeat, double fraction);

 private:
  using Clock = std::chrono::steady_clock;

  void show(Clock::time_point now);

  const bool is_shown_;
  const Clock::time_point start_ = Clock::now();
  std::mutex mutex_;
  std::vector<double> shares_;
  Clock::time_point next_show_ = start_;
};

}  // namespace repose::cli
