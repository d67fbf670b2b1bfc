#include "cli/help/help_commands.h"

#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/whole_file.h"
#include "cli/common/output.h"
#include "cli/help/completion.h"
#include "cli/help/manual.h"

namespace repose::cli {
namespace {

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
