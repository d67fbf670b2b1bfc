#include "base/file_set.h"

#include <map>
#include <set>
#include <sstream>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include "base/atomic_file.h"
#include "base/fingerprint.h"

namespace repose::base {

bool is_pattern(const std::filesystem::path& file) {
  if (file.filename().string().find_first_of("*?") == std::string::npos) return false;
  std::error_code ignored;
  return !std::filesystem::exists(file, ignored);
}

bool matches(const std::string& name, const std::filesystem::path& pattern) {
  return fnmatch(pattern.filename().c_str(), name.c_str(), FNM_PERIOD) == 0;
}

namespace {

namespace fs = std::filesystem;

constexpr const char* kList = ".repose-files";

/// Fingerprints that a file may have, by name: both old and new while the files are being written.
using Fingerprints = std::map<std::string, std::set<std::string>>;

/// One per line: "FINGERPRINT NAME".
Fingerprints read_list(const fs::path& folder) {
  Fingerprints list;
  std::istringstream lines(read_file_if_there(folder / kList).value_or(""));
  for (std::string fingerprint, name;
       lines >> fingerprint && std::getline(lines >> std::ws, name);) {
    list[name].insert(fingerprint);
  }
  return list;
}

void write_list(const fs::path& folder, const Fingerprints& list) {
  std::string text;
  for (const auto& [name, fingerprints] : list) {
    for (const std::string& each : fingerprints) text += fmt::format("{} {}\n", each, name);
  }
  write_whole_file(folder / kList, text);
}

Fingerprints list_of(const std::vector<NamedText>& files) {
  Fingerprints list;
  for (const NamedText& file : files) list[file.name] = {fingerprint({file.text})};
  return list;
}

/// Whether a file may be replaced or removed.
bool is_as_listed(const fs::path& folder, const std::string& name, const Fingerprints& list,
                  Unlisted unlisted) {
  const auto text = read_file_if_there(folder / name);
  if (!text) return true;
  const auto listed = list.find(name);
  if (listed == list.end()) return unlisted == Unlisted::ours;
  return listed->second.contains(fingerprint({*text}));
}

void check_nothing_is_lost(const fs::path& folder, const std::vector<NamedText>& files,
                           const Fingerprints& earlier, Unlisted unlisted) {
  std::vector<std::string> lost;
  for (const NamedText& file : files) {
    if (read_file_if_there(folder / file.name) == file.text) continue;
    if (!is_as_listed(folder, file.name, earlier, unlisted)) lost.push_back(file.name);
  }
  if (lost.empty()) return;
  refuse(folder,
         fmt::format("these files are not as written by repose, and would be lost: {}",
                     fmt::join(lost, ", ")),
         "choose another folder, or move them away.");
}

}  // namespace

void check_file_set(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (std::error_code ignored; error || !fs::is_directory(folder, ignored)) {
    refuse(folder,
           fmt::format("the folder cannot be created ({})",
                       error ? error.message() : "there is a file of that name"),
           "choose a writable place.");
  }
  check_can_write(folder / kList);
}

void write_file_set(const fs::path& folder, const std::vector<NamedText>& files,
                    Unlisted unlisted) {
  check_file_set(folder);
  const Fingerprints earlier = read_list(folder);
  const Fingerprints now = list_of(files);
  check_nothing_is_lost(folder, files, earlier, unlisted);
  for (const NamedText& file : files) check_can_write(folder / file.name);
  Fingerprints both = earlier;
  for (const auto& [name, fingerprints] : now) both[name].merge(std::set(fingerprints));
  write_list(folder, both);
  for (const NamedText& file : files) write_whole_file(folder / file.name, file.text);
  for (const auto& [name, fingerprints] : earlier) {
    // Files changed since then now belong to the user.
    if (now.contains(name) || !is_as_listed(folder, name, earlier, Unlisted::users)) continue;
    fs::remove(folder / name);
  }
  write_list(folder, now);
}

}  // namespace repose::base
