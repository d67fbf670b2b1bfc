#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/part_file.h"

/// Files that are there whole or not at all: written beside their place, to the disk, and then
/// renamed, so that a full disk, a kill or a power cut leaves the earlier file as it was. Links and
/// the rights of the earlier file stay.
namespace repose::base {

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
std::unique_ptr<PartFile> part_of(const std::filesystem::path& file);
void put_in_place(PartFile& part, const std::filesystem::path& file);

/// Finds out before long work whether write_whole_file would succeed; changes nothing but what a
/// killed process left of the same file.
/// @throws base::InputError  as write_whole_file.
void check_can_write(const std::filesystem::path& file);

}  // namespace repose::base
