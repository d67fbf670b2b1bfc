#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "base/input_error.h"
#include "cli/common/output.h"

namespace repose::cli {

/// An option of a command: how it is typed, what it is for, and where its text goes.
struct CommandOption {
  std::string name;        ///< "--json"; without dashes: a word known by its place
  std::string value_name;  ///< "FILE|-"; empty for a switch
  std::string help;
  /// A list takes the option several times, or all words that are left.
  std::variant<std::string*, std::vector<std::string>*, bool*> target;
  bool is_required = false;
  int word_count = 0;                   ///< of a list of words, when there must be just so many
  std::vector<std::string> words = {};  ///< that it may be, where its value_name does not say
};

/// A subcommand: what its help says, its options, and what carries it out once they are parsed.
struct Command {
  std::string name;
  std::string summary;
  std::vector<CommandOption> options;
  std::string notes = {};    ///< below the options in its help
  std::string missing = {};  ///< said when something required is not given
  /// Its options by the fields that libraries find fault with; lives as long as the program.
  base::FieldNames fields = {};
  std::function<ExitCode()> run = {};
};

}  // namespace repose::cli
