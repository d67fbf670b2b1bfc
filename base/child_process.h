#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace repose::base {

/// How a program is started.
struct ProcessStart {
  std::vector<std::string> words;  ///< the program, searched for in PATH, and its arguments
  std::filesystem::path folder;    ///< working directory
  std::filesystem::path output;    ///< receives stdout and stderr; an existing file is truncated
};

/// How a program ended.
struct ProcessEnd {
  int exit_code = 0;
  int signal = 0;  ///< that terminated it; 0: none

  bool is_good() const { return exit_code == 0 && signal == 0; }
  /// "exit code 3", "ended by signal 11 (Segmentation fault)". Shells report a signal that ended
  /// their command as exit code 128 + signal.
  std::string text() const;
};

/// A child process with empty standard input, in its own process group: Ctrl-C in the terminal does
/// not reach it. The destructor ends everything that it started: its group, and any process that
/// made its own group or session but kept the environment, which carries a mark. Its output file
/// stays locked (flock) as long as any of them has it open, even if this program is killed.
class ChildProcess {
 public:
  /// @throws InputError  the output file cannot be written, or an earlier program still has it
  ///   open.
  /// @throws std::system_error  no process can be created.
  explicit ChildProcess(const ProcessStart& start);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ChildProcess(ChildProcess&&) = delete;
  ChildProcess& operator=(ChildProcess&&) = delete;

  /// Does not wait: std::nullopt while it runs. Processes that it left running are killed.
  std::optional<ProcessEnd> end();

  void ask_to_end() const;  ///< SIGTERM to it and all that it started
  void kill() const;        ///< SIGKILL

 private:
  void signal_all(int signal) const;

  std::string mark_;
  pid_t pid_ = 0;
  std::optional<ProcessEnd> end_;
};

/// Makes this program receive SIGTERM if the one that started it as a ChildProcess dies, even by
/// SIGKILL. Does nothing in a program that was started otherwise.
void end_with_parent();

/// Whether a program that was started with this output still has it open, even if the process that
/// started it was killed. False if there is no such file.
bool is_in_use(const std::filesystem::path& output);

/// The last lines that a program printed, made safe for a terminal.
std::vector<std::string> last_lines(const std::filesystem::path& output, std::size_t most);

}  // namespace repose::base
