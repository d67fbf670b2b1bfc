#include "base/child_process.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/atomic_file.h"
#include "base/text.h"

namespace repose::base {
namespace {

constexpr mode_t kRightsOfOutput = 0666;  // less what the process's mask takes away

class OutputHandle {
 public:
  OutputHandle(const std::filesystem::path& file, int flags)
      : number_(::open(file.c_str(), flags | O_CLOEXEC, kRightsOfOutput)) {}
  ~OutputHandle() {
    if (number_ >= 0) ::close(number_);
  }
  OutputHandle(const OutputHandle&) = delete;
  OutputHandle& operator=(const OutputHandle&) = delete;
  OutputHandle(OutputHandle&&) = delete;
  OutputHandle& operator=(OutputHandle&&) = delete;

  int number() const { return number_; }
  /// flock belongs to the open file description, which child processes share.
  bool is_locked_by_others() const {
    return ::flock(number_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  }

 private:
  int number_;
};

void require_spawned(int error) {
  if (error != 0) throw std::system_error(error, std::generic_category());
}

constexpr const char* kMarkName = "REPOSE_STARTED";
constexpr const char* kMarkVariable = "REPOSE_STARTED=";

/// Unique across processes and over time.
std::string new_mark() {
  static std::atomic<int> count = 0;
  return fmt::format("{}.{}.{}", ::getpid(), ++count,
                     std::chrono::steady_clock::now().time_since_epoch().count());
}

/// This process's environment, with the mark appended to those that it already carries.
std::vector<std::string> marked_environment(const std::string& mark) {
  std::vector<std::string> all;
  std::string marks = kMarkVariable;
  for (char** one = ::environ; one != nullptr && *one != nullptr; ++one) {
    if (std::string_view(*one).starts_with(kMarkVariable)) {
      marks = std::string(*one) + ' ';
    } else {
      all.emplace_back(*one);
    }
  }
  all.push_back(marks + mark);
  return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Processes whose environment is readable and contains the mark.
std::set<pid_t> marked_processes(const std::string& mark) {
  std::set<pid_t> found;
  std::error_code error;
  for (std::filesystem::directory_iterator entry("/proc", error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    pid_t pid = 0;
    const auto [stopped_at, fault] = std::from_chars(name.data(), name.data() + name.size(), pid);
    if (fault != std::errc{} || stopped_at != name.data() + name.size()) continue;
    std::ifstream file(entry->path() / "environ", std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    if (text.find(mark) != std::string::npos) found.insert(pid);
  }
  return found;
}

pid_t spawn(const ProcessStart& start, int output, const std::string& mark) {
  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
  require_spawned(::posix_spawn_file_actions_init(&actions));
  require_spawned(::posix_spawnattr_init(&attributes));
  std::vector<std::string> copies = start.words, variables = marked_environment(mark);
  const std::vector<char*> words = pointers_to(copies), environment = pointers_to(variables);
  pid_t pid = 0;
  int error = ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  if (error == 0) error = ::posix_spawn_file_actions_adddup2(&actions, output, 1);
  if (error == 0) error = ::posix_spawn_file_actions_adddup2(&actions, output, 2);
  if (error == 0) error = ::posix_spawn_file_actions_addchdir_np(&actions, start.folder.c_str());
  if (error == 0) error = ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  if (error == 0) error = ::posix_spawnattr_setpgroup(&attributes, 0);  // a new one
  if (error == 0) {
    error = ::posix_spawnp(&pid, words.front(), &actions, &attributes, words.data(),
                           environment.data());
  }
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  require_spawned(error);
  return pid;
}

}  // namespace

void end_with_parent() {
  const char* const marks = std::getenv(kMarkName);
  if (marks == nullptr) return;
  const std::string_view all = marks;
  const std::string_view last = all.substr(all.rfind(' ') + 1);  // npos + 1 is 0
  const std::string parent = fmt::format("{}.", ::getppid());
  // Processes started by the child itself, a shell for example, have another parent.
  if (!last.starts_with(parent)) return;
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  // The parent may have died before the prctl call.
  if (fmt::format("{}.", ::getppid()) != parent) ::raise(SIGTERM);
}

std::string ProcessEnd::text() const {
  constexpr int kOfShells = 128;
  const int by = signal != 0 ? signal : exit_code - kOfShells;
  const char* name = by > 0 ? ::sigdescr_np(by) : nullptr;
  if (name != nullptr) return fmt::format("ended by signal {} ({})", by, name);
  return fmt::format("exit code {}", exit_code);
}

ChildProcess::ChildProcess(const ProcessStart& start) : mark_(new_mark()) {
  const OutputHandle output(start.output, O_WRONLY | O_CREAT | O_APPEND);
  if (output.number() < 0) {
    refuse(start.output,
           fmt::format("cannot be written ({})", std::generic_category().message(errno)),
           "choose a writable folder, or free some space there.");
  }
  if (output.is_locked_by_others()) {
    refuse(start.output, "a program that was started earlier is still running and writes there",
           "wait until it has ended, or end it.");
  }
  if (::ftruncate(output.number(), 0) != 0) require_spawned(errno);
  pid_ = spawn(start, output.number(), mark_);
}

ChildProcess::~ChildProcess() {
  if (end_) return;
  kill();
  ::waitpid(pid_, nullptr, 0);
}

std::optional<ProcessEnd> ChildProcess::end() {
  if (end_) return end_;
  // The group keeps its number until the program itself is waited for.
  siginfo_t info{};
  if (::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
      info.si_pid == 0) {
    return std::nullopt;
  }
  kill();
  int status = 0;
  ::waitpid(pid_, &status, 0);
  end_ = WIFSIGNALED(status) ? ProcessEnd{.exit_code = 0, .signal = WTERMSIG(status)}
                             : ProcessEnd{.exit_code = WEXITSTATUS(status), .signal = 0};
  return end_;
}

void ChildProcess::ask_to_end() const { signal_all(SIGTERM); }

void ChildProcess::kill() const { signal_all(SIGKILL); }

void ChildProcess::signal_all(int signal) const {
  constexpr int kPasses = 5;  // to catch processes started meanwhile
  ::kill(-pid_, signal);
  std::set<pid_t> told;
  for (int pass = 0; pass < kPasses; ++pass) {
    bool is_new = false;
    for (const pid_t one : marked_processes(mark_)) {
      // The group has already been signalled.
      if (!told.insert(one).second || ::getpgid(one) == pid_) continue;
      ::kill(one, signal);
      is_new = true;
    }
    if (!is_new) return;
  }
}

bool is_in_use(const std::filesystem::path& output) {
  const OutputHandle file(output, O_RDONLY);
  return file.number() >= 0 && file.is_locked_by_others();
}

std::vector<std::string> last_lines(const std::filesystem::path& output, std::size_t most) {
  constexpr std::streamoff kEnd_bytes = 8192;
  constexpr std::size_t kLongest = 300;  // bytes of a line
  std::ifstream file(output, std::ios::binary | std::ios::ate);
  if (!file) return {};
  const std::streamoff size = file.tellg();
  file.seekg(std::max(std::streamoff{0}, size - kEnd_bytes));
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    // A progress bar overwrites its line.
    if (!line.empty() && line.back() == '\r') line.pop_back();
    line.erase(0, line.rfind('\r') + 1);
    if (line.empty()) continue;
    if (line.size() > kLongest) line = line.substr(0, kLongest) + " ...";
    lines.push_back(printable(line));
  }
  if (lines.size() > most)
    lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(most));
  return lines;
}

}  // namespace repose::base
