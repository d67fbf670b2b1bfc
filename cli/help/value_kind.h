#pragma once

#include <string>
#include <vector>

#include "cli/common/command.h"

namespace repose::cli {

/// What can be typed for an option or a word, told by how its help calls the value.
struct ValueKind {
  std::vector<std::string> words;  ///< the small ones of "auto|paper"
  bool is_file = false;            ///< also folders
};

ValueKind value_kind(const CommandOption& option);

inline bool is_switch(const CommandOption& option) { return option.value_name.empty(); }
inline bool is_known_by_place(const CommandOption& option) { return option.name.front() != '-'; }
inline bool is_list(const CommandOption& option) {
  return std::holds_alternative<std::vector<std::string>*>(option.target);
}

}  // namespace repose::cli
