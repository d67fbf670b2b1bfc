#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "base/input_error.h"
#include "cli/common/output.h"

namespace repose::cli {

/// An option of a command: how it is typed, its purpose, and where its text is stored.
struct CommandOption {
  std::string name;        ///< "--json"; without dashes: a positional argument
  std::string value_name;  ///< "FILE|-"; empty for a switch
  std::string help;
  /// A list allows the option several times, or takes all remaining words.
  std::variant<std::string*, std::vector<std::string>*, bool*> target;
  bool is_required = false;
  int word_count = 0;                   ///< exact number of words for a list; 0: any number
  std::vector<std::string> words = {};  ///< allowed values, if its value_name does not list them
};

/// A subcommand: its help, its options, and the function that runs it after parsing.
struct Command {
  std::string name;
  std::string summary;
  std::vector<CommandOption> options;
  std::string notes = {};    ///< below the options in its help
  std::string missing = {};  ///< shown if a required option is missing
  /// Maps the fields named in library errors to this command's options; must outlive the program's
  /// run.
  base::FieldNames fields = {};
  std::function<ExitCode()> run = {};
};

}  // namespace repose::cli
