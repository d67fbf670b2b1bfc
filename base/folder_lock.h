#pragma once

#include <filesystem>
#include <string>

namespace repose::base {

/// An exclusive lock between processes. It is released when the process ends, however that happens;
/// the empty file stays.
class FolderLock {
 public:
  /// @param file  whose lock represents the folder; it may lie in a subfolder
  /// @param fix   what to do if another process holds it
  /// @throws base::InputError  another process holds it; the message names it.
  FolderLock(const std::filesystem::path& folder, const std::filesystem::path& file,
             const std::string& fix = "wait until it has finished, or choose another folder.");
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// Whether another process holds the lock of that file. False if there is no such file.
bool is_locked_by_another(const std::filesystem::path& file);

}  // namespace repose::base
