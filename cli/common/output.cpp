#include "cli/common/output.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "base/printable.h"
#include "base/whole_file.h"

namespace repose::cli {
namespace {

void print(std::string_view text) {
  const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (is_written && std::fflush(stdout) == 0) return;
  throw base::InputError(
      {.where = "standard output",
       .value = "cannot be written",
       .fix = "check whether the disk is full or the program reading it has ended."});
}

}  // namespace

void prepare_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  // The library that writes films prints what cli/render says in words.
  ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // NOLINT(concurrency-mt-unsafe): before threads
  // What is opened takes the lowest free number. Nothing can be written to these three.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) == -1) ::open("/dev/null", O_RDONLY);
  }
}

void Outputs::add(const std::string& file, std::string text) {
  if (file.empty()) return;
  if (file == kStandardOutput) {
    printed_ = std::move(text);
    has_printed_ = true;
  } else {
    files_.push_back({file, std::move(text)});
  }
}

void Outputs::show(std::string text) { shown_ = std::move(text); }

void Outputs::write_files() {
  for (const auto& [file, text] : std::exchange(files_, {})) {
    try {
      base::write_whole_file(file, text);
    } catch (const base::InputError& error) {
      errors_.insert(errors_.end(), error.faults().begin(), error.faults().end());
    }
  }
}

void Outputs::write() {
  write_files();
  try {
    print(has_printed_ ? printed_ : shown_);
  } catch (const base::InputError& error) {
    errors_.insert(errors_.end(), error.faults().begin(), error.faults().end());
  }
  if (!errors_.empty()) throw base::InputError(std::exchange(errors_, {}));
}

void add_faults(const base::InputError& error, std::vector<std::string>& lines,
                base::FieldNames names) {
  for (const base::Fault& fault : error.faults()) lines.push_back(fault.text(names));
}

void print_error_text(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void print_line(std::string_view line) noexcept {
  try {
    print_error_text("repose: " + base::printable(line) + '\n');
  } catch (const std::bad_alloc&) {
    print_error_text("repose: out of memory, so the error cannot be described\n");
  }
}

void print_lines(const std::vector<std::string>& lines) noexcept {
  for (const std::string& line : lines) print_line(line);
}

}  // namespace repose::cli
