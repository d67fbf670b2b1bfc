#include "cli/calibrate/calibrate_progress.h"

#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "cli/common/terminal.h"

namespace repose::cli {
namespace {

constexpr const char* kClearLine = "\r\033[K";

std::string time_text(double seconds) {
  constexpr double kMinute_s = 60;
  return seconds < 2 * kMinute_s ? fmt::format("{:.0f} s", std::ceil(seconds))
                                 : fmt::format("{:.0f} min", std::ceil(seconds / kMinute_s));
}

}  // namespace

StudyProgressLine::StudyProgressLine() : is_terminal_(is_terminal(stderr)) {}

StudyProgressLine::~StudyProgressLine() {
  if (is_terminal_) fmt::print(stderr, "{}", kClearLine);
}

void StudyProgressLine::tell(const calibrate::StudyProgress& progress) {
  const bool is_new = progress.stage != stage_;
  if (is_new) {
    stage_ = progress.stage;
    stage_start_ = Clock::now();
  }
  if (!is_terminal_) {
    if (is_new) fmt::print(stderr, "{}: {} simulations\n", progress.stage, progress.of);
    return;
  }
  std::string line = fmt::format("{}{}: {} of {} simulations", kClearLine, progress.stage,
                                 progress.done, progress.of);
  if (progress.done > 0 && progress.seconds_done > 0) {
    const std::chrono::duration<double> spent = Clock::now() - stage_start_;
    const double left = progress.seconds_of - progress.seconds_done;
    line += fmt::format(", {} left", time_text(spent.count() * left / progress.seconds_done));
  }
  fmt::print(stderr, "{}", line);
  std::fflush(stderr);
}

}  // namespace repose::cli
