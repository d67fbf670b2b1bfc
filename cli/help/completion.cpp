#include "cli/help/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/help/value_kind.h"

namespace repose::cli {
namespace {

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

/// What follows one option, in bash.
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

/// A text between single quotes, in which _arguments gives some letters a meaning.
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

}  // namespace

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

}  // namespace repose::cli
