#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>

namespace repose::cli {

/// "measured 3 of 10, 12 s left" on standard error, only when that is a terminal. The line goes
/// away with the object. advance() may be called from any thread.
class Progress {
 public:
  explicit Progress(std::size_t total, const char* done_word = "measured");
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  Progress(Progress&&) = delete;
  Progress& operator=(Progress&&) = delete;

  void advance();

 private:
  void show() const;

  const std::size_t total_;
  const char* const done_word_;
  const bool is_shown_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::size_t done_ = 0;
};

}  // namespace repose::cli
