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

/// Width of the terminal that `stream` is connected to, in columns; 80 if it is not a terminal.
int columns_of(std::FILE* stream);

/// True for terminals, unless NO_COLOR is set (https://no-color.org).
bool wants_colour(std::FILE* stream);

/// "40 s", "12 min": rounded up.
std::string time_text(double seconds);

/// One line on standard error that is overwritten, such as "measured 3 of 10, 12 s left"; shown
/// only on a terminal. The destructor removes the line. Any thread may report.
class ProgressLine {
 public:
  /// @param left  format of the remaining time: "{} left"
  explicit ProgressLine(std::string left = "{} left");
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ProgressLine(ProgressLine&&) = delete;
  ProgressLine& operator=(ProgressLine&&) = delete;

  bool is_shown() const { return is_shown_; }

  /// What is done, and the completed fraction of all work, from 0 to 1. A report shortly after the
  /// previous one is skipped unless show_next() was called.
  void report(const std::string& done, double fraction);
  void show_next();

  /// ", 12 s left" if the fraction is large enough for an estimate; otherwise empty.
  std::string left_text(double fraction) const;

 private:
  using Clock = std::chrono::steady_clock;

  const bool is_shown_;
  std::mutex mutex_;
  const std::string left_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point next_shown_ = start_;
};

/// A progress line for a number of equal work items.
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

/// A progress line for work items that each report their own progress, such as films.
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

/// From now on Ctrl-C (or SIGTERM, or closing the terminal) sets the returned flag, so that work
/// can stop in an orderly way; a second one ends the program at once.
const std::atomic<bool>& watch_for_interrupt();

}  // namespace repose::cli
