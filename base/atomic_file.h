#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

/// Files that exist whole or not at all: written beside their final place, flushed to disk and then
/// renamed, so that a full disk, a kill or a power cut leaves the earlier file as it was. Links and
/// the earlier file's permissions are preserved.

namespace repose::base {

/// The folder that a file is in; the current one if its name has none.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// A file being written beside its final place. put_in_place() atomically replaces the earlier
/// file, keeping its permissions; otherwise the destructor removes it. A killed process leaves it
/// behind, unlocked, for remove_leftovers_of() or remove_leftovers_in().
class TemporaryFile {
 public:
  /// @param file  its final place; a link is followed
  /// @throws std::system_error  it cannot be created.
  explicit TemporaryFile(const std::filesystem::path& file);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  TemporaryFile(TemporaryFile&&) = delete;
  TemporaryFile& operator=(TemporaryFile&&) = delete;

  /// For libraries that write to a file name. Keeps the extension.
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

/// Removes temporary files that killed processes left in a folder: those of `file` only, or all.
void remove_leftovers_of(const std::filesystem::path& file);
void remove_leftovers_in(const std::filesystem::path& folder);

/// @throws base::InputError  "FILE: what. Fix: ..."
[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what,
                         const std::string& fix);

/// Size limit of files that are read whole, unless the caller sets a lower one.
inline constexpr std::uintmax_t kLargestFile_bytes = std::uintmax_t{1} << 30;

/// The bytes of a file. Pipes, devices and sockets are refused without being read: they may block,
/// or never end.
/// @throws base::InputError  "FILE: what. Rule: ... Fix: ..." if it does not exist, cannot be read,
///   is not a regular file or is larger than `largest_bytes`.
std::string read_whole_file(const std::filesystem::path& file,
                            std::uintmax_t largest_bytes = kLargestFile_bytes);

/// The same; std::nullopt if there is no such file.
/// @throws base::InputError  if it exists but cannot be read.
std::optional<std::string> read_file_if_there(const std::filesystem::path& file,
                                              std::uintmax_t largest_bytes = kLargestFile_bytes);

/// @throws base::InputError  "FILE: what. Fix: ..." when the place cannot be written.
void write_whole_file(const std::filesystem::path& file, std::span<const std::byte> content);
void write_whole_file(const std::filesystem::path& file, std::string_view text);

/// For libraries that write to a file name; call put_in_place() afterwards.
/// @throws base::InputError  both: "FILE: what. Fix: ..." when the place cannot be written.
std::unique_ptr<TemporaryFile> part_of(const std::filesystem::path& file);
void put_in_place(TemporaryFile& part, const std::filesystem::path& file);

/// Checks before long work whether write_whole_file would succeed; changes nothing except removing
/// what a killed process left of the same file.
/// @throws base::InputError  as write_whole_file.
void check_can_write(const std::filesystem::path& file);

}  // namespace repose::base
