#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace repose::base {

/// The folder that a file is in; the present one where its name says none.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// A file that is being written beside the place that it is for. Put into that place it replaces
/// the earlier file at once, with its rights; otherwise it goes away. A process that was killed
/// leaves it there, unlocked, for remove_leftovers().
class PartFile {
 public:
  /// @param file  its place; of a link, what the link leads to
  /// @throws std::system_error  it cannot be made.
  explicit PartFile(const std::filesystem::path& file);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  PartFile(PartFile&&) = delete;
  PartFile& operator=(PartFile&&) = delete;

  /// For libraries that write by name. It keeps the extension.
  const std::filesystem::path& path() const { return part_; }

  /// @throws std::system_error
  void write(std::span<const std::byte> content) const;

  /// Once this returns, neither a kill nor a power cut loses the file.
  /// @throws std::system_error  the earlier file is as it was.
  void put_in_place();

 private:
  std::filesystem::path file_;
  std::filesystem::path part_;
  int descriptor_ = -1;
};

/// Removes what killed processes were writing in a folder: for `file` alone, or for all of its
/// files.
void remove_leftovers_of(const std::filesystem::path& file);
void remove_leftovers_in(const std::filesystem::path& folder);

}  // namespace repose::base
