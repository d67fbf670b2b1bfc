#include "base/whole_file.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace repose::base {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& what, const char* fix) {
  throw std::invalid_argument(fmt::format("{}: {}. Fix: {}", file.string(), what, fix));
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Devices and pipes (/dev/null, a named pipe) are written to; renaming would replace them.
bool is_device(const fs::path& file) {
  std::error_code ignored;
  return fs::is_other(file, ignored);
}

/// A name of its own for each process and call: two of them may write the same file at once.
fs::path temporary_name(const fs::path& file) {
  static std::atomic<unsigned> count{0};
  return folder_of(file) /
         fmt::format(".{}.{}-{}.part", file.filename().string(), ::getpid(), count++);
}

void check_place(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) {
    refuse(file, "is a folder, no file can have this name", "name a file inside it.");
  }
  if (!fs::is_directory(folder_of(file), ignored)) {
    refuse(file, fmt::format("there is no folder {}", folder_of(file).string()),
           "create the folder or correct the name.");
  }
}

/// Writes `content` to a file that `mode` opens; the reason when it failed.
std::error_code write(const fs::path& file, const char* mode, std::span<const std::byte> content) {
  const auto system_error = [] { return std::error_code(errno, std::generic_category()); };
  std::FILE* out = std::fopen(file.c_str(), mode);
  if (!out) return system_error();
  std::error_code error;
  if (!content.empty() &&  // empty content may have no memory at all
      std::fwrite(content.data(), 1, content.size(), out) != content.size()) {
    error = system_error();
  }
  if (std::fclose(out) != 0 && !error) error = system_error();
  return error;
}

/// Removes the temporary file, whatever happens.
class Temporary {
 public:
  explicit Temporary(fs::path file) : file_(std::move(file)) {}
  ~Temporary() {
    std::error_code ignored;
    fs::remove(file_, ignored);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  Temporary(Temporary&&) = delete;
  Temporary& operator=(Temporary&&) = delete;

  const fs::path& file() const { return file_; }

 private:
  fs::path file_;
};

constexpr const char* kFixPlace = "choose a folder you may write to, or free some space there.";

}  // namespace

void write_whole_file(const fs::path& file, std::span<const std::byte> content) {
  check_place(file);
  if (is_device(file)) {
    if (const auto error = write(file, "wb", content)) {
      refuse(file, fmt::format("cannot be written ({})", error.message()), kFixPlace);
    }
    return;
  }
  const Temporary temporary(temporary_name(file));
  std::error_code error = write(temporary.file(), "wbx", content);
  if (!error) fs::rename(temporary.file(), file, error);
  if (error) refuse(file, fmt::format("cannot be written ({})", error.message()), kFixPlace);
}

void write_whole_file(const fs::path& file, std::string_view text) {
  write_whole_file(file, std::as_bytes(std::span(text)));
}

void check_can_write(const fs::path& file) {
  check_place(file);
  if (is_device(file)) return;
  const Temporary temporary(temporary_name(file));
  if (const auto error = write(temporary.file(), "wbx", {})) {
    refuse(file, fmt::format("cannot be written ({})", error.message()), kFixPlace);
  }
}

}  // namespace repose::base
