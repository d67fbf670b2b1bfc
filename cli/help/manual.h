#pragma once

#include <string>
#include <vector>

#include "cli/common/command.h"

namespace repose::cli {

/// A page of the manual, for man(1).
struct ManualPage {
  std::string file;  ///< "repose-measure.1"
  std::string text;  ///< in the language of man(7)
};

/// One page of the program, one a command. Proved by Manual.* in tests/cli.
std::vector<ManualPage> manual_pages(const std::vector<Command>& commands);

}  // namespace repose::cli
