#include "base/part_file.h"

#include <atomic>
#include <cerrno>
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

namespace repose::base {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kAsUsual = 0666;  // less what the process's mask takes away

[[noreturn]] void fail() { throw std::system_error(errno, std::generic_category()); }

/// Where a link leads to, whether that is there or not.
fs::path place_of(const fs::path& file) {
  fs::path place = file;
  constexpr int kMostLinks = 40;
  for (int k = 0; fs::is_symlink(place); ++k) {
    if (k == kMostLinks) throw std::system_error(ELOOP, std::generic_category());
    const fs::path target = fs::read_symlink(place);
    place = target.is_absolute() ? target : place.parent_path() / target;
  }
  return place;
}

/// With what the names of a file's parts begin. Names have 255 bytes at most.
std::string part_beginning(const fs::path& file) {
  constexpr std::size_t kMost = 200;
  return fmt::format(".{}.", file.filename().string().substr(0, kMost));
}

/// A name of its own for each process and call: two of them may write the same file at once.
fs::path part_name(const fs::path& file) {
  static std::atomic<unsigned> count{0};
  constexpr std::size_t kMost = 8;
  return folder_of(file) / fmt::format("{}{}-{}.part{}", part_beginning(file), ::getpid(), count++,
                                       file.extension().string().substr(0, kMost));
}

/// A new file, locked as long as it is open; -1 when somebody took it for a leftover meanwhile.
int locked_file(const fs::path& part) {
  const int descriptor = ::open(part.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kAsUsual);
  if (descriptor < 0) fail();
  struct stat status {};
  // File systems without locks have no leftovers removed either.
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && ::fstat(descriptor, &status) == 0 &&
      status.st_nlink == 0) {
    ::close(descriptor);
    return -1;
  }
  return descriptor;
}

/// To the disk. Devices and file systems that cannot do it have nothing to lose.
void flush(int descriptor) {
  if (::fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP && errno != ENOSYS) fail();
}

/// The name too: it is an entry of its folder.
void flush_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // it may be written to, not read
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

PartFile::PartFile(const fs::path& file) : file_(place_of(file)) {
  while (descriptor_ < 0) {
    part_ = part_name(file_);
    descriptor_ = locked_file(part_);
  }
}

PartFile::~PartFile() {
  if (descriptor_ < 0) return;
  ::unlink(part_.c_str());
  ::close(descriptor_);
}

void PartFile::write(std::span<const std::byte> content) const {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    content = content.subspan(static_cast<std::size_t>(written));
  }
}

void PartFile::put_in_place() {
  struct stat earlier {};
  if (::stat(file_.c_str(), &earlier) == 0) {
    // Another's file can be replaced, but not be given back to them.
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
    return;  // who writes the file says what is wrong
  } catch (const std::system_error&) {
    return;
  }
}

void remove_leftovers_in(const fs::path& folder) {
  remove_leftovers(folder, [](const std::string&) { return true; });
}

}  // namespace repose::base
