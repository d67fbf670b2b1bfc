#pragma once

#include <functional>
#include <string>

#include "cli/common/exit_code.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace repose::cli {

/// A subcommand: its options, and what carries it out once they are parsed.
struct Command {
  CLI::App* app = nullptr;
  std::function<ExitCode()> run;
  std::string missing;  ///< said when something required is not given
};

}  // namespace repose::cli
