#pragma once

#include <filesystem>
#include <string>

namespace repose::base {

/// An exclusive lock between processes. It ends with the process, however that
/// ends; the file stays, empty.
class FolderLock {
 public:
  /// @param file  whose lock stands for the folder; it may be deeper in it
  /// @param fix   what to do when another process has it
  /// @throws base::InputError  another process has it, which is named.
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

/// Whether another process has the lock of that file. False where there is no such file.
bool is_locked_by_another(const std::filesystem::path& file);

}  // namespace repose::base
