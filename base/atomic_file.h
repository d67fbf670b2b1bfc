#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

/// Files that are there whole or not at all: written beside their place, to the disk, and then
/// renamed, so that a full disk, a kill or a power cut leaves the earlier file as it was. Links and
/// the rights of the earlier file stay.

namespace repose::base {

/// The folder that a file is in; the present one where its name says none.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// A file that is being written beside the place that it is for. Put into that place it replaces
/// the earlier file at once, with its rights; otherwise it goes away. A process that was killed
/// leaves it there, unlocked, for remove_leftovers().
class TemporaryFile {
 public:
  /// @param file  its place; of a link, what the link leads to
  /// @throws std::system_error  it cannot be made.
  explicit TemporaryFile(const std::filesystem::path& file);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  TemporaryFile(TemporaryFile&&) = delete;
  TemporaryFile& operator=(TemporaryFile&&) = delete;

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

/// @throws base::InputError  "FILE: what. Fix: ..."
[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what,
                         const std::string& fix);

/// More than this no file that is read whole may have, unless its reader allows less.
inline constexpr std::uintmax_t kLargestFile_bytes = std::uintmax_t{1} << 30;

/// The bytes of a file. Pipes, devices and sockets are refused without being opened for long: they
/// may have nothing to say, or never end.
/// @throws base::InputError  "FILE: what. Rule: ... Fix: ..." when it is not there, cannot be
///   read, is no regular file or larger than `largest_bytes`.
std::string read_whole_file(const std::filesystem::path& file,
                            std::uintmax_t largest_bytes = kLargestFile_bytes);

/// The same; none when there is no such file.
/// @throws base::InputError  when it is there and cannot be read.
std::optional<std::string> read_file_if_there(const std::filesystem::path& file,
                                              std::uintmax_t largest_bytes = kLargestFile_bytes);

/// @throws base::InputError  "FILE: what. Fix: ..." when the place cannot be written.
void write_whole_file(const std::filesystem::path& file, std::span<const std::byte> content);
void write_whole_file(const std::filesystem::path& file, std::string_view text);

/// For libraries that write by name; then to be put in place.
/// @throws base::InputError  both: "FILE: what. Fix: ..." when the place cannot be written.
std::unique_ptr<TemporaryFile> part_of(const std::filesystem::path& file);
void put_in_place(TemporaryFile& part, const std::filesystem::path& file);

/// Finds out before long work whether write_whole_file would succeed; changes nothing but what a
/// killed process left of the same file.
/// @throws base::InputError  as write_whole_file.
void check_can_write(const std::filesystem::path& file);

}  // namespace repose::base
