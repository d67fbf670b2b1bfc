#include "cli/help/help.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/version.h"
#include "cli/common/command.h"
#include "cli/common/output.h"

namespace repose::cli {

namespace {

/// What can be typed for an option or a word, derived from its value's name in the help.
struct ValueKind {
  std::vector<std::string> words;  ///< the lower-case ones of "auto|paper"
  bool is_file = false;            ///< also folders
};

inline bool is_switch(const CommandOption& option) { return option.value_name.empty(); }

inline bool is_known_by_place(const CommandOption& option) { return option.name.front() != '-'; }

inline bool is_list(const CommandOption& option) {
  return std::holds_alternative<std::vector<std::string>*>(option.target);
}

// Value names of files and folders contain one of them.
constexpr std::array<std::string_view, 9> kOfFiles = {
    "FILE", "FOLDER", "PICTURE", "STUDY", "READINGS", "SCAN", "STATE", "TABLE", "VIDEO"};

bool is_word(const std::string& part) {
  return !part.empty() && std::all_of(part.begin(), part.end(), [](unsigned char c) {
    return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '-';
  }) && std::islower(static_cast<unsigned char>(part.front())) != 0;
}

ValueKind value_kind(const CommandOption& option) {
  ValueKind kind{.words = option.words};
  std::istringstream parts(option.value_name);
  for (std::string part; std::getline(parts, part, '|');) {
    if (is_word(part)) kind.words.push_back(part);
  }
  kind.is_file = std::any_of(kOfFiles.begin(), kOfFiles.end(), [&](std::string_view name) {
    return option.value_name.find(name) != std::string::npos;
  });
  return kind;
}

/// Scripts that let a shell complete commands, options, their values and file names when the
/// tabulator key is pressed. Proved by Completion.* in tests/cli, in the shells themselves.
std::string bash_completion(const std::vector<Command>& commands);

std::string zsh_completion(const std::vector<Command>& commands);

constexpr const char* kBashBegin = R"(# Completes the words of repose in bash.
_repose() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command= words= files=
  ((COMP_CWORD > 1)) && command=${COMP_WORDS[1]}
  case "$command $before" in
)";

constexpr const char* kBashMiddle = R"(    *)
      case "$command" in
)";

constexpr const char* kBashEnd = R"(      esac ;;
  esac
  [[ -n $files && $word != -* ]] && mapfile -t COMPREPLY < <(compgen -f -- "$word") || COMPREPLY=()
  local found
  mapfile -t found < <(compgen -W "$words" -- "$word")
  COMPREPLY+=("${found[@]}")
}

complete -o filenames -F _repose repose
)";

constexpr const char* kZshBegin = R"(#compdef repose
# Completes the words of repose in zsh.
_repose() {
  local -a commands=(
)";

constexpr const char* kZshMiddle = R"(  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  (( CURRENT -= 1 ))
  case $command in
)";

constexpr const char* kZshEnd = R"(  esac
}

if [[ $funcstack[1] == _repose ]]; then _repose "$@"; else compdef _repose repose; fi
)";

std::string names_of(const std::vector<Command>& commands) {
  std::string names;

  for (const Command& command : commands) names += command.name + ' ';

  return names + "--help --version";
}

/// Completion after one option, in bash.
std::string bash_case(const Command& command, const CommandOption& option) {
  const ValueKind kind = value_kind(option);

  return fmt::format("    \"{} {}\") words='{}' files={} ;;\n", command.name, option.name,
                     fmt::join(kind.words, " "), kind.is_file ? "1" : "");
}

/// Options and words of one command, in bash.
std::string bash_case(const Command& command) {
  std::string words;

  bool takes_files = false;

  for (const CommandOption& option : command.options) {
    if (is_known_by_place(option)) {
      const ValueKind kind = value_kind(option);
      for (const std::string& word : kind.words) words += word + ' ';
      takes_files = takes_files || kind.is_file;
    } else {
      words += option.name + ' ';
    }
  }

  return fmt::format("        {}) words='{}--help' files={} ;;\n", command.name, words,
                     takes_files ? "1" : "");
}

/// A text in single quotes, with characters that are special to _arguments escaped.
std::string zsh_text(const std::string& text) {
  std::string quoted;

  for (const char letter : text) {
    if (letter == '\'') {
      quoted += "'\\''";
      continue;
    }
    if (letter == '[' || letter == ']' || letter == ':' || letter == '\\') quoted += '\\';
    quoted += letter;
  }

  return quoted;
}

/// Alternatives that _arguments offers for a value.
std::string zsh_action(const CommandOption& option) {
  const ValueKind kind = value_kind(option);

  if (kind.words.empty()) return kind.is_file ? "_files" : " ";

  const std::string words = fmt::format("({})", fmt::join(kind.words, " "));

  return kind.is_file ? fmt::format("_alternative \"w:word:{}\" \"f:file:_files\"", words) : words;
}

std::string zsh_spec(const CommandOption& option, int place) {
  const std::string value = ':' + zsh_text(option.value_name) + ':' + zsh_action(option);

  if (is_known_by_place(option)) {
    return (is_list(option) ? "*" : std::to_string(place)) + value;
  }

  return fmt::format("{}{}[{}]{}", is_list(option) ? "*" : "", option.name, zsh_text(option.help),
                     is_switch(option) ? "" : value);
}

std::string zsh_case(const Command& command) {
  std::string text = fmt::format("    {})\n      _arguments", command.name);

  int place = 1;

  for (const CommandOption& option : command.options) {
    text += fmt::format(" \\\n        '{}'", zsh_spec(option, place));
    place += is_known_by_place(option) ? 1 : 0;
  }

  return text + " \\\n        '--help[Print this help message and exit]'\n      ;;\n";
}

std::string bash_completion(const std::vector<Command>& commands) {
  std::string script = kBashBegin;

  for (const Command& command : commands) {
    for (const CommandOption& option : command.options) {
      if (!is_known_by_place(option) && !is_switch(option)) script += bash_case(command, option);
    }
  }

  script += kBashMiddle;

  for (const Command& command : commands) script += bash_case(command);

  script += fmt::format("        '') words='{}' ;;\n", names_of(commands));

  return script + kBashEnd;
}

std::string zsh_completion(const std::vector<Command>& commands) {
  std::string script = kZshBegin;

  for (const Command& command : commands) {
    script += fmt::format("    '{}:{}'\n", command.name, zsh_text(command.summary));
  }

  script += kZshMiddle;

  for (const Command& command : commands) script += zsh_case(command);

  return script + kZshEnd;
}

/// A page of the manual, for man(1).
struct ManualPage {
  std::string file;  ///< "repose-measure.1"
  std::string text;  ///< in the language of man(7)
};

/// Text that man prints unchanged: hyphens that can be copied, no line taken as a request.
std::string literal(const std::string& text) {
  std::string escaped;
  bool begins_line = true;
  for (const char letter : text) {
    if (begins_line && (letter == '.' || letter == '\'')) escaped += "\\&";
    begins_line = letter == '\n';
    if (letter == '-') {
      escaped += "\\-";
    } else if (letter == '\\') {
      escaped += "\\e";
    } else {
      escaped += letter;
    }
  }
  return escaped;
}

std::string heading(const std::string& page) {
  std::string name;
  for (const char letter : page) {
    name += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  }
  return fmt::format(".TH {} 1 \"\" \"{}\" \"repose\"\n", literal(name), base::kProgram);
}

/// A section in which line breaks are kept.
std::string as_typed(const std::string& name, const std::string& text) {
  const std::size_t first = text.find_first_not_of('\n');
  if (first == std::string::npos) return {};
  return fmt::format(".SH {}\n.nf\n{}\n.fi\n", name, literal(text.substr(first)));
}

std::string synopsis(const Command& command) {
  std::string text = fmt::format(".SH SYNOPSIS\n.B repose {}\n[\\fIOPTION\\fR]...\n", command.name);
  for (const CommandOption& option : command.options) {
    if (is_known_by_place(option)) text += fmt::format("\\fI{}\\fR\n", literal(option.value_name));
  }
  return text;
}

std::string options(const Command& command) {
  std::string text = ".SH OPTIONS\n";
  for (const CommandOption& option : command.options) {
    const bool is_word = is_known_by_place(option);
    text += fmt::format(
        ".TP\n{}{}\n{}.\n", is_word ? "" : fmt::format("\\fB{}\\fR ", literal(option.name)),
        is_switch(option) ? "" : fmt::format("\\fI{}\\fR", literal(option.value_name)),
        literal(option.help));
  }
  return text;
}

ManualPage page_of(const Command& command) {
  const std::string name = "repose-" + command.name;
  return {name + ".1",
          heading(name) +
              fmt::format(".SH NAME\n{} \\- {}\n", literal(name), literal(command.summary)) +
              synopsis(command) + options(command) + as_typed("NOTES", command.notes) +
              ".SH SEE ALSO\n.BR repose (1)\n"};
}

ManualPage program_page(const std::vector<Command>& commands) {
  std::string text = heading("repose") +
                     ".SH NAME\nrepose \\- measure heaps and calibrate contact parameters\n" +
                     ".SH SYNOPSIS\n.B repose\n\\fICOMMAND\\fR [\\fIOPTION\\fR]...\n" +
                     fmt::format(".SH DESCRIPTION\n{}\n.SH COMMANDS\n", literal(kAbout));
  for (const Command& command : commands) {
    text += fmt::format(".TP\n.BR repose\\-{} (1)\n{}.\n", command.name, literal(command.summary));
  }
  return {"repose.1", text + as_typed("EXAMPLES AND EXIT CODES", kExamples)};
}

/// One page for the program, and one for each command. Proved by Manual.* in tests/cli.
std::vector<ManualPage> manual_pages(const std::vector<Command>& commands) {
  std::vector<ManualPage> pages = {program_page(commands)};
  for (const Command& command : commands) pages.push_back(page_of(command));
  return pages;
}

constexpr const char* kCompletionNotes = R"(
Prints a script. To install it for one user:
  bash  repose completion bash >> ~/.bash_completion
  zsh   repose completion zsh > FOLDER/_repose, with FOLDER from $fpath
Then start a new shell. Installing repose does both for all users.
)";

constexpr const char* kManualNotes = R"(
Writes repose.1 and a page for each command, replacing earlier ones. For one
user:
  repose manual ~/.local/share/man/man1
  man repose-measure
Installing repose does it for all users.
)";

ExitCode print_completion(const std::string& shell, const std::vector<Command>& commands) {
  if (shell != "bash" && shell != "zsh") {
    throw base::InputError({.where = "completion",
                            .subject = "shell",
                            .value = fmt::format("is {}, but", shell),
                            .rule = "must be bash or zsh",
                            .fix = "repose completion bash, or repose completion zsh."});
  }
  Outputs outputs;
  outputs.show(shell == "bash" ? bash_completion(commands) : zsh_completion(commands));
  outputs.write();
  return ExitCode::done;
}

ExitCode write_manual(const std::filesystem::path& folder, const std::vector<Command>& commands) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    base::refuse(folder, fmt::format("cannot create the folder ({})", error.message()),
                 "choose a writable folder.");
  }
  Outputs outputs;
  for (const ManualPage& page : manual_pages(commands)) {
    outputs.add((folder / page.file).string(), page.text);
  }
  outputs.write();
  return ExitCode::done;
}

}  // namespace

std::vector<Command> help_commands(const std::vector<Command>& others) {
  const auto word = std::make_shared<std::string>();
  Command completion = {.name = "completion",
                        .summary = "Print a shell completion script",
                        .options = {{"shell", "bash|zsh", "Shell", word.get(), true}},
                        .notes = kCompletionNotes,
                        .missing = "a shell is needed. Fix: repose completion bash|zsh."};
  Command manual = {.name = "manual",
                    .summary = "Write the man pages",
                    .options = {{"folder", "FOLDER", "Output folder", word.get(), true}},
                    .notes = kManualNotes,
                    .missing = "a folder is needed. Fix: repose manual FOLDER."};
  std::vector<Command> all = others;
  all.insert(all.end(), {completion, manual});
  completion.run = [word, all] { return print_completion(*word, all); };
  manual.run = [word, all] { return write_manual(*word, all); };
  return {completion, manual};
}

}  // namespace repose::cli
