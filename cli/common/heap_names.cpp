#include "cli/common/heap_names.h"

namespace repose::cli {

std::string heap_by_name(const std::filesystem::path& picture) {
  std::string name = (picture.parent_path() / picture.stem()).string();
  const std::size_t last = name.find_last_not_of("0123456789");
  const bool has_number = last != std::string::npos && last + 1 < name.size();
  if (has_number && last > 0 && (name[last] == '_' || name[last] == '-') && name[last - 1] != '/') {
    name.resize(last);
  }
  return name;
}

}  // namespace repose::cli
