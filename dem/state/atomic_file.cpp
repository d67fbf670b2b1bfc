#include "dem/state/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace repose::dem {
namespace {

namespace fs = std::filesystem;

/// A name of its own for each process and call: two of them may write the same file at once.
fs::path temporary_name(const fs::path& file) {
  static std::atomic<unsigned> count{0};
  return file.parent_path() /
         fmt::format(".{}.{}-{}.part", file.filename().string(), ::getpid(), count++);
}

std::error_code write(const fs::path& file, std::string_view text) {
  const auto system_error = [] { return std::error_code(errno, std::generic_category()); };
  std::FILE* out = std::fopen(file.c_str(), "wbx");
  if (!out) return system_error();
  std::error_code error;
  if (std::fwrite(text.data(), 1, text.size(), out) != text.size()) error = system_error();
  if (std::fclose(out) != 0 && !error) error = system_error();
  return error;
}

}  // namespace

void write_atomically(const fs::path& file, std::string_view text) {
  const fs::path temporary = temporary_name(file);
  std::error_code error = write(temporary, text);
  if (!error) fs::rename(temporary, file, error);
  if (!error) return;
  std::error_code ignored;
  fs::remove(temporary, ignored);
  throw std::invalid_argument(
      fmt::format("{}: cannot be written ({}). Fix: choose a folder that exists and that you may "
                  "write to, or free some space there.",
                  file.string(), error.message()));
}

}  // namespace repose::dem
