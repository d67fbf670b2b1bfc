#include "base/atomic_file.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <functional>
#include <regex>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/input_error.h"

namespace repose::base {

namespace {

namespace fs = std::filesystem;

constexpr mode_t kAsUsual = 0666;  // less what the process's mask takes away

[[noreturn]] void fail() { throw std::system_error(errno, std::generic_category()); }

/// The target of a link, whether it exists or not.
fs::path place_of(const fs::path& file) {
  fs::path place = file;
  constexpr int kMaxLinks = 40;
  for (int k = 0; fs::is_symlink(place); ++k) {
    if (k == kMaxLinks) throw std::system_error(ELOOP, std::generic_category());
    const fs::path target = fs::read_symlink(place);
    place = target.is_absolute() ? target : place.parent_path() / target;
  }
  return place;
}

/// Prefix of the names of a file's temporary files. File names have at most 255 bytes.
std::string part_beginning(const fs::path& file) {
  constexpr std::size_t kMax = 200;
  return fmt::format(".{}.", file.filename().string().substr(0, kMax));
}

/// Unique per process and call: two of them may write the same file at once.
fs::path part_name(const fs::path& file) {
  static std::atomic<unsigned> count{0};
  constexpr std::size_t kMax = 8;
  return folder_of(file) / fmt::format("{}{}-{}.part{}", part_beginning(file), ::getpid(), count++,
                                       file.extension().string().substr(0, kMax));
}

/// A new file, locked while it is open; -1 if another process removed it as a leftover meanwhile.
int locked_file(const fs::path& part) {
  const int descriptor = ::open(part.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kAsUsual);
  if (descriptor < 0) fail();
  struct stat status {};
  // On file systems without locks, leftovers are not removed either.
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && ::fstat(descriptor, &status) == 0 &&
      status.st_nlink == 0) {
    ::close(descriptor);
    return -1;
  }
  return descriptor;
}

/// Flushes to disk. Devices and file systems that cannot have nothing to lose.
void flush(int descriptor) {
  if (::fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP && errno != ENOSYS) fail();
}

/// Flushes the name too: it is an entry of its folder.
void flush_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // writable but not readable
  ::fsync(descriptor);
  ::close(descriptor);
}

void remove_unlocked(const fs::path& part) {
  const int descriptor = ::open(part.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) ::unlink(part.c_str());
  ::close(descriptor);
}

void remove_leftovers(const fs::path& folder,
                      const std::function<bool(const std::string&)>& is_of) {
  static const std::regex part(R"(\..+\.\d+-\d+\.part(\..*)?)");
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with('.') && is_of(name) && std::regex_match(name, part)) {
      remove_unlocked(entry->path());
    }
  }
}

}  // namespace

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

TemporaryFile::TemporaryFile(const fs::path& file) : file_(place_of(file)) {
  while (descriptor_ < 0) {
    part_ = part_name(file_);
    descriptor_ = locked_file(part_);
  }
}

TemporaryFile::~TemporaryFile() {
  if (descriptor_ < 0) return;
  ::unlink(part_.c_str());
  ::close(descriptor_);
}

void TemporaryFile::write(std::span<const std::byte> content) const {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    content = content.subspan(static_cast<std::size_t>(written));
  }
}

void TemporaryFile::put_in_place() {
  struct stat earlier {};
  if (::stat(file_.c_str(), &earlier) == 0) {
    // Another user's file can be replaced, but ownership cannot be given back.
    if (::fchown(descriptor_, earlier.st_uid, earlier.st_gid) != 0) errno = 0;
    if (::fchmod(descriptor_, earlier.st_mode & ALLPERMS) != 0) fail();
  }
  flush(descriptor_);
  if (::rename(part_.c_str(), file_.c_str()) != 0) fail();
  ::close(std::exchange(descriptor_, -1));
  flush_folder(folder_of(file_));
}

void remove_leftovers_of(const fs::path& file) {
  try {
    const fs::path place = place_of(file);
    const std::string beginning = part_beginning(place);
    remove_leftovers(folder_of(place),
                     [&](const std::string& name) { return name.starts_with(beginning); });
  } catch (const fs::filesystem_error&) {
    return;  // writing the file will report the error
  } catch (const std::system_error&) {
    return;
  }
}

void remove_leftovers_in(const fs::path& folder) {
  remove_leftovers(folder, [](const std::string&) { return true; });
}

namespace {

namespace fs = std::filesystem;

/// Devices and pipes (/dev/null, a named pipe) are written to directly; renaming would replace
/// them. So are names of open streams such as /dev/stdout, whatever they refer to.
bool is_device(const fs::path& file) {
  std::error_code ignored;
  const fs::path folder = fs::weakly_canonical(folder_of(file), ignored);
  return fs::is_other(file, ignored) || folder == "/dev" || folder.string().starts_with("/proc/");
}

void check_place(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) {
    refuse(file, "is a folder, so no file can have this name", "name a file inside it.");
  }
  if (!fs::is_directory(folder_of(file), ignored)) {
    refuse(file, fmt::format("there is no folder {}", folder_of(file).string()),
           "create the folder or correct the name.");
  }
  if (fs::exists(file, ignored) && ::access(file.c_str(), W_OK) != 0) {
    refuse(file, "exists and is write-protected",
           "choose another name, or get permission to write it.");
  }
}

/// Writes `content` to a device or pipe; returns the error if it failed.
std::error_code write_to_device(const fs::path& file, std::span<const std::byte> content) {
  const auto system_error = [] { return std::error_code(errno, std::generic_category()); };
  std::FILE* out = std::fopen(file.c_str(), "wb");
  if (!out) return system_error();
  std::error_code error;
  if (!content.empty() &&  // empty content may have a null pointer
      std::fwrite(content.data(), 1, content.size(), out) != content.size()) {
    error = system_error();
  }
  if (std::fclose(out) != 0 && !error) error = system_error();
  return error;
}

[[noreturn]] void refuse_writing(const fs::path& file, const std::error_code& error) {
  refuse(file, fmt::format("cannot be written ({})", error.message()),
         "choose a writable folder, or free some space there.");
}

}  // namespace

void refuse(const fs::path& file, const std::string& what, const std::string& fix) {
  throw InputError({.where = file.string(), .value = what, .fix = fix});
}

std::unique_ptr<TemporaryFile> part_of(const fs::path& file) {
  check_place(file);
  try {
    return std::make_unique<TemporaryFile>(file);
  } catch (const std::system_error& error) {
    refuse_writing(file, error.code());
  }
}

void put_in_place(TemporaryFile& part, const fs::path& file) {
  try {
    part.put_in_place();
  } catch (const std::system_error& error) {
    refuse_writing(file, error.code());
  }
}

void write_whole_file(const fs::path& file, std::span<const std::byte> content) {
  check_place(file);
  if (is_device(file)) {
    if (const auto error = write_to_device(file, content)) refuse_writing(file, error);
    return;
  }
  try {
    TemporaryFile part(file);
    part.write(content);
    part.put_in_place();
  } catch (const std::system_error& error) {
    refuse_writing(file, error.code());
  }
}

void write_whole_file(const fs::path& file, std::string_view text) {
  write_whole_file(file, std::as_bytes(std::span(text)));
}

void check_can_write(const fs::path& file) {
  check_place(file);
  if (is_device(file)) return;
  remove_leftovers_of(file);
  try {
    const TemporaryFile part(file);
  } catch (const std::system_error& error) {
    refuse_writing(file, error.code());
  }
}

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

/// Reads to the end, wherever that is now: the file may grow meanwhile.
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
  // Checked before it is opened: opening a device may have side effects.
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
