#include "base/file_pattern.h"

#include <system_error>

#include <fnmatch.h>

namespace repose::base {

bool is_pattern(const std::filesystem::path& file) {
  if (file.filename().string().find_first_of("*?") == std::string::npos) return false;
  std::error_code ignored;
  return !std::filesystem::exists(file, ignored);
}

bool matches(const std::string& name, const std::filesystem::path& pattern) {
  return fnmatch(pattern.filename().c_str(), name.c_str(), FNM_PERIOD) == 0;
}

}  // namespace repose::base
