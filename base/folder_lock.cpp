#include "base/folder_lock.h"

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace repose::base {
namespace {

constexpr mode_t kForAll = 0666;  // less what the process's mask takes away

struct flock whole_file() {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return lock;
}

/// "process 4711", or "another process" if it runs on another machine.
std::string owner_of(int descriptor) {
  struct flock lock = whole_file();
  const bool is_known = ::fcntl(descriptor, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  return is_known && lock.l_pid > 0 ? fmt::format("process {}", lock.l_pid) : "another process";
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, const std::filesystem::path& file,
                       const std::string& fix)
    : descriptor_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kForAll)) {
  if (descriptor_ < 0) {
    refuse(file, fmt::format("cannot be written ({})", std::generic_category().message(errno)),
           "choose a writable folder, or free some space there.");
  }
  const struct flock lock = whole_file();
  if (::fcntl(descriptor_, F_SETLK, &lock) == 0) return;
  if (errno != EACCES && errno != EAGAIN) return;  // a file system without locks
  const std::string owner = owner_of(descriptor_);
  ::close(descriptor_);
  refuse(folder, owner + " is using it", fix);
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

bool is_locked_by_another(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct flock lock = whole_file();
  const bool is_locked = ::fcntl(descriptor, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  ::close(descriptor);
  return is_locked;
}

}  // namespace repose::base
