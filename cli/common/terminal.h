#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <string>
#include <vector>

namespace repose::cli {

bool is_terminal(std::FILE* stream);

/// Columns of the terminal that `stream` is; 80 when it is none.
int columns_of(std::FILE* stream);

/// Colours are for terminals, and not where NO_COLOR is set (https://no-color.org).
bool wants_colour(std::FILE* stream);

/// "40 s", "12 min": rounded up.
std::string time_text(double seconds);

/// One line on standard error that is written over, such as "measured 3 of 10, 12 s left"; only
/// when that is a terminal. The line goes away with the object. Any thread may report.
class ProgressLine {
 public:
  /// @param left  how the time left is said: "{} left"
  explicit ProgressLine(std::string left = "{} left");
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ProgressLine(ProgressLine&&) = delete;
  ProgressLine& operator=(ProgressLine&&) = delete;

  bool is_shown() const { return is_shown_; }

  /// What is done, and which fraction of all the work that is, from 0 to 1. A report that follows
  /// another at once is not shown, unless show_next() says so.
  void report(const std::string& done, double fraction);
  void show_next();

  /// ", 12 s left" for a fraction that tells; else empty.
  std::string left_text(double fraction) const;

 private:
  using Clock = std::chrono::steady_clock;

  const bool is_shown_;
  std::mutex mutex_;
  const std::string left_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point next_shown_ = start_;
};

/// A progress line for a number of equal pieces of work.
class Progress {
 public:
  explicit Progress(std::size_t total, const char* done_word = "measured");

  void advance();

 private:
  const std::size_t total_;
  const char* const done_word_;
  std::mutex mutex_;
  std::size_t done_ = 0;
  ProgressLine line_;
};

/// A progress line for pieces of work that each tell how far they are, such as films.
class PartsProgress {
 public:
  explicit PartsProgress(std::size_t parts, const char* done_word);

  /// @param fraction  of this part, from 0 to 1
  void report(std::size_t part, double fraction);

 private:
  const char* const done_word_;
  std::mutex mutex_;
  std::vector<double> done_;
  ProgressLine line_;
};

/// From now on Ctrl-C (or SIGTERM, or the end of the terminal) makes what this returns true, for
/// work to stop in good order; the second one ends the program at once.
const std::atomic<bool>& watch_for_interrupt();

}  // namespace repose::cli
