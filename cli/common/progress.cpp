#include "cli/common/progress.h"

#include <cmath>
#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "cli/common/terminal.h"

namespace repose::cli {
namespace {

constexpr const char* kClearLine = "\r\033[K";

}  // namespace

Progress::Progress(std::size_t total, const char* done_word)
    : total_(total), done_word_(done_word), is_shown_(total > 1 && is_terminal(stderr)) {
  if (is_shown_) show();
}

Progress::~Progress() {
  if (is_shown_) fmt::print(stderr, "{}", kClearLine);
}

void Progress::advance() {
  if (!is_shown_) return;
  const std::lock_guard lock(mutex_);
  ++done_;
  show();
}

void Progress::show() const {
  std::string line = fmt::format("{}{} {} of {}", kClearLine, done_word_, done_, total_);
  if (done_ > 0) {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    const double left_s =
        spent.count() * static_cast<double>(total_ - done_) / static_cast<double>(done_);
    line += fmt::format(", {:.0f} s left", std::ceil(left_s));
  }
  fmt::print(stderr, "{}", line);
  std::fflush(stderr);
}

}  // namespace repose::cli
