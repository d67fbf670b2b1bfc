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
  std::vector<std::string> words;  ///< the program, looked for in PATH, and its arguments
  std::filesystem::path folder;    ///< that it works in
  std::filesystem::path output;    ///< what it prints, on either stream; an earlier file is emptied
};

/// How a program ended.
struct ProcessEnd {
  int exit_code = 0;
  int signal = 0;  ///< that ended it; 0: none

  bool is_good() const { return exit_code == 0 && signal == 0; }
  /// "exit code 3", "ended by signal 11 (Segmentation fault)". Shells tell the signal that ended
  /// what they ran as 128 more.
  std::string text() const;
};

/// A program beside this one, with nothing on its standard input. It is a process group: Ctrl-C in
/// the terminal does not reach it. All that it started ends with the object: its group, and
/// whatever has made a group or session of its own and kept the environment, which marks it. Its
/// output file stays locked (flock) as long as any of them has it open, even if this program is
/// killed.
class ChildProcess {
 public:
  /// @throws InputError  the output file cannot be written, or an earlier program still has it.
  /// @throws std::system_error  no process can be made.
  explicit ChildProcess(const ProcessStart& start);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ChildProcess(ChildProcess&&) = delete;
  ChildProcess& operator=(ChildProcess&&) = delete;

  /// Does not wait: none while it runs. What it left running behind it is killed.
  std::optional<ProcessEnd> end();

  void ask_to_end() const;  ///< SIGTERM to all of it
  void kill() const;        ///< SIGKILL

 private:
  void signal_all(int signal) const;

  std::string mark_;
  pid_t pid_ = 0;
  std::optional<ProcessEnd> end_;
};

/// Asks this program to end (SIGTERM) when the one that has started it as a ChildProcess dies, as
/// of SIGKILL. Does nothing in a program that was started otherwise.
void end_with_parent();

/// Whether a program that was started with this output still has it open, of a process that was
/// killed, say. False where there is no such file.
bool is_in_use(const std::filesystem::path& output);

/// The last lines of what a program printed, such that a terminal can show them.
std::vector<std::string> last_lines(const std::filesystem::path& output, std::size_t most);

}  // namespace repose::base
