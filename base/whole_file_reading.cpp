#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/input_error.h"
#include "base/whole_file.h"

namespace repose::base {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_unreadable(const fs::path& file, int error) {
  refuse(file, fmt::format("cannot be read ({})", std::generic_category().message(error)),
         "correct the name, or get permission to read it.");
}

[[noreturn]] void refuse_large(const fs::path& file, std::uintmax_t bytes, std::uintmax_t largest) {
  constexpr double kMebibyte = 1 << 20;
  throw InputError(
      {.where = file.string(),
       .value = fmt::format("has {:.1f} MiB", static_cast<double>(bytes) / kMebibyte),
       .rule = fmt::format("at most {:.0f} MiB", static_cast<double>(largest) / kMebibyte),
       .fix = "give the right file, or make it smaller."});
}

/// A file opened for reading.
class Descriptor {
 public:
  explicit Descriptor(const fs::path& file)
      // Without O_NONBLOCK, opening a pipe would wait for someone to write to it.
      : number_(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;

  int number() const { return number_; }

 private:
  int number_;
};

const char* kind_of(mode_t mode) {
  if (S_ISFIFO(mode)) return "is a pipe, not a file";
  if (S_ISSOCK(mode)) return "is a socket, not a file";
  return "is a device, not a file";
}

/// Its size, once it is known to be a regular file of no more than `largest`.
std::uintmax_t checked_size(const fs::path& file, const struct stat& status,
                            std::uintmax_t largest) {
  if (S_ISDIR(status.st_mode)) refuse(file, "is a folder", "name a file inside it.");
  if (!S_ISREG(status.st_mode)) {
    refuse(file, kind_of(status.st_mode), "save its output to a file, and give that.");
  }
  const auto size = static_cast<std::uintmax_t>(status.st_size);
  if (size > largest) refuse_large(file, size, largest);
  return size;
}

/// To its end, wherever that is now: it may grow while it is read.
std::string read_all(const fs::path& file, const Descriptor& in, std::uintmax_t size,
                     std::uintmax_t largest) {
  std::string bytes;
  bytes.reserve(size);
  std::array<char, 1 << 16> chunk{};
  for (;;) {
    const ssize_t read = ::read(in.number(), chunk.data(), chunk.size());
    if (read < 0 && errno == EINTR) continue;
    if (read < 0) refuse_unreadable(file, errno);
    if (read == 0) return bytes;
    bytes.append(chunk.data(), static_cast<std::size_t>(read));
    if (bytes.size() > largest) refuse_large(file, bytes.size(), largest);
  }
}

}  // namespace

std::optional<std::string> read_file_if_there(const fs::path& file, std::uintmax_t largest_bytes) {
  struct stat status {};
  // Looked at before it is opened: opening a device may already do something.
  if (::stat(file.c_str(), &status) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) return std::nullopt;
    refuse_unreadable(file, errno);
  }
  checked_size(file, status, largest_bytes);
  const Descriptor in(file);
  if (in.number() < 0 || ::fstat(in.number(), &status) != 0) refuse_unreadable(file, errno);
  return read_all(file, in, checked_size(file, status, largest_bytes), largest_bytes);
}

std::string read_whole_file(const fs::path& file, std::uintmax_t largest_bytes) {
  std::optional<std::string> content = read_file_if_there(file, largest_bytes);
  if (!content) refuse(file, "there is no such file", "correct the name.");
  return *std::move(content);
}

}  // namespace repose::base
