#include "cli/common/terminal.h"

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "cli/common/output.h"

namespace repose::cli {

namespace {

constexpr int kUsualColumns = 80;

/// Null if it is not set.
const char* environment(const char* name) {
  return std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody changes the environment
}

}  // namespace

bool is_terminal(std::FILE* stream) { return isatty(fileno(stream)) != 0; }

int columns_of(std::FILE* stream) {
  winsize size{};
  if (!is_terminal(stream) || ioctl(fileno(stream), TIOCGWINSZ, &size) != 0 || size.ws_col == 0) {
    return kUsualColumns;
  }
  return size.ws_col;
}

bool wants_colour(std::FILE* stream) {
  const char* no_colour = environment("NO_COLOR");
  const char* kind = environment("TERM");
  const bool is_plain = kind == nullptr || std::string_view(kind) == "dumb";
  return is_terminal(stream) && !is_plain && (no_colour == nullptr || *no_colour == '\0');
}

namespace {

constexpr const char* kClearLine = "\r\033[K";
constexpr std::chrono::milliseconds kBetweenReports{200};
constexpr double kEnoughToTell =
    .01;  // of the work done, before the remaining time can be estimated

}  // namespace

std::string time_text(double seconds) {
  constexpr double kMinute_s = 60;
  return seconds < 2 * kMinute_s ? fmt::format("{:.0f} s", std::ceil(seconds))
                                 : fmt::format("{:.0f} min", std::ceil(seconds / kMinute_s));
}

ProgressLine::ProgressLine(std::string left)
    : is_shown_(is_terminal(stderr)), left_(std::move(left)) {}

ProgressLine::~ProgressLine() {
  if (is_shown_) print_error_text(kClearLine);
}

void ProgressLine::report(const std::string& done, double fraction) {
  if (!is_shown_) return;
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  if (now < next_shown_) return;
  next_shown_ = now + kBetweenReports;
  print_error_text(kClearLine + done + left_text(fraction));
}

std::string ProgressLine::left_text(double fraction) const {
  if (fraction < kEnoughToTell) return {};
  const std::chrono::duration<double> spent = Clock::now() - start_;
  return ", " +
         fmt::format(fmt::runtime(left_), time_text(spent.count() * (1 - fraction) / fraction));
}

void ProgressLine::show_next() {
  const std::lock_guard lock(mutex_);
  next_shown_ = Clock::now();
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

PartsProgress::PartsProgress(std::size_t parts, const char* done_word)
    : done_word_(done_word), done_(parts) {}

void PartsProgress::report(std::size_t part, double fraction) {
  if (!line_.is_shown()) return;
  const std::lock_guard lock(mutex_);
  done_[part] = fraction;
  const double whole =
      std::accumulate(done_.begin(), done_.end(), 0.0) / static_cast<double>(done_.size());
  line_.report(fmt::format("{} {:.0f} %", done_word_, 100 * whole), whole);
}

namespace {

std::atomic<bool> is_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set by a signal handler");

void on_interrupt(int signal) {
  is_interrupted = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

const std::atomic<bool>& watch_for_interrupt() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  // Processes started with nohup keep ignoring SIGHUP.
  if (std::signal(SIGHUP, on_interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  return is_interrupted;
}

}  // namespace repose::cli
