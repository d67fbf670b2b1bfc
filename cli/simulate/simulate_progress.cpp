#include "cli/simulate/simulate_progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>

#include <fmt/format.h>

#include "cli/common/terminal.h"

namespace repose::cli {
namespace {

constexpr const char* kClearLine = "\r\033[K";
constexpr std::chrono::milliseconds kBetweenShows{200};
constexpr double kEnoughToTell = .01;  // of the work done, before a time left means anything

}  // namespace

FractionProgress::FractionProgress(std::size_t repeats)
    : is_shown_(is_terminal(stderr)), shares_(repeats, 0) {}

FractionProgress::~FractionProgress() {
  if (is_shown_) fmt::print(stderr, "{}", kClearLine);
}

void FractionProgress::tell(std::size_t repeat, double fraction) {
  if (!is_shown_) return;
  const std::lock_guard lock(mutex_);
  shares_[repeat] = std::clamp(fraction, 0., 1.);
  const auto now = Clock::now();
  if (now < next_show_) return;
  next_show_ = now + kBetweenShows;
  show(now);
}

void FractionProgress::show(Clock::time_point now) {
  const double done =
      std::accumulate(shares_.begin(), shares_.end(), 0.) / static_cast<double>(shares_.size());
  std::string line = fmt::format("{}simulated {:.0f} % of {} {}", kClearLine, 100 * done,
                                 shares_.size(), shares_.size() == 1 ? "repeat" : "repeats");
  if (done >= kEnoughToTell) {
    const std::chrono::duration<double> spent = now - start_;
    line += fmt::format(", {:.0f} s left", std::ceil(spent.count() * (1 - done) / done));
  }
  fmt::print(stderr, "{}", line);
  std::fflush(stderr);
}

}  // namespace repose::cli
