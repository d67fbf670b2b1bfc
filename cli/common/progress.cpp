#include "cli/common/progress.h"

#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "cli/common/output.h"
#include "cli/common/terminal.h"

namespace repose::cli {
namespace {

constexpr const char* kClearLine = "\r\033[K";
constexpr std::chrono::milliseconds kBetweenReports{200};
constexpr double kEnoughToTell = .01;  // of the work done, before a time left means anything

std::string time_text(double seconds) {
  constexpr double kMinute_s = 60;
  return seconds < 2 * kMinute_s ? fmt::format("{:.0f} s", std::ceil(seconds))
                                 : fmt::format("{:.0f} min", std::ceil(seconds / kMinute_s));
}

}  // namespace

ProgressLine::ProgressLine() : is_shown_(is_terminal(stderr)) {}

ProgressLine::~ProgressLine() {
  if (is_shown_) print_error_text(kClearLine);
}

void ProgressLine::report(const std::string& done, double fraction) {
  if (!is_shown_) return;
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  if (now < next_shown_) return;
  next_shown_ = now + kBetweenReports;
  std::string line = kClearLine + done;
  if (fraction >= kEnoughToTell) {
    const std::chrono::duration<double> spent = now - start_;
    line += fmt::format(", {} left", time_text(spent.count() * (1 - fraction) / fraction));
  }
  print_error_text(line);
}

void ProgressLine::begin_stage() {
  const std::lock_guard lock(mutex_);
  start_ = Clock::now();
  next_shown_ = start_;
}

Progress::Progress(std::size_t total, const char* done_word)
    : total_(total), done_word_(done_word) {
  line_.report(fmt::format("{} 0 of {}", done_word_, total_), 0);
}

void Progress::advance() {
  const std::lock_guard lock(mutex_);
  ++done_;
  line_.report(fmt::format("{} {} of {}", done_word_, done_, total_),
               static_cast<double>(done_) / static_cast<double>(total_));
}

}  // namespace repose::cli
