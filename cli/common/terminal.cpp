#include "cli/common/terminal.h"

#include <cstdlib>
#include <string_view>

#include <sys/ioctl.h>
#include <unistd.h>

namespace repose::cli {
namespace {

constexpr int kUsualColumns = 80;

/// Null when it is not set.
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

}  // namespace repose::cli
