#include "base/whole_file.h"

#include <cerrno>
#include <cstdio>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "base/input_error.h"
#include "base/part_file.h"

namespace repose::base {
namespace {

namespace fs = std::filesystem;

/// Devices and pipes (/dev/null, a named pipe) are written to; renaming would replace them. So are
/// names of open streams such as /dev/stdout, whatever these are.
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

/// Writes `content` to what is no file; the reason when it failed.
std::error_code write_to_device(const fs::path& file, std::span<const std::byte> content) {
  const auto system_error = [] { return std::error_code(errno, std::generic_category()); };
  std::FILE* out = std::fopen(file.c_str(), "wb");
  if (!out) return system_error();
  std::error_code error;
  if (!content.empty() &&  // empty content may have no memory at all
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

std::unique_ptr<PartFile> part_of(const fs::path& file) {
  check_place(file);
  try {
    return std::make_unique<PartFile>(file);
  } catch (const std::system_error& error) {
    refuse_writing(file, error.code());
  }
}

void put_in_place(PartFile& part, const fs::path& file) {
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
    PartFile part(file);
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
    const PartFile part(file);
  } catch (const std::system_error& error) {
    refuse_writing(file, error.code());
  }
}

}  // namespace repose::base
