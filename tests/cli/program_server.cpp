#include "tests/cli/program_server.h"

#include <cstdlib>
#include <iterator>
#include <stdexcept>

#include <sys/socket.h>
#include <unistd.h>

#include "cli/program.h"

namespace repose::testing {
namespace {

/// The client's end of the socket on which runs are requested.
int& to_server() {
  static int end = -1;
  return end;
}

/// A request: everything that defines a run, as null-terminated texts.
std::string packed(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += text + '\0';
  return all;
}

std::vector<std::string> unpacked(const std::string& all) {
  std::vector<std::string> texts;
  for (std::size_t at = 0; at < all.size(); at += texts.back().size() + 1) {
    texts.emplace_back(all.c_str() + at);
  }
  return texts;
}

std::vector<std::string> environment() {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) all.emplace_back(*entry);
  return all;
}

/// `request`: folder, out, err, number of environment variables, the variables, the command line.
[[noreturn]] void run(std::vector<std::string> request) {
  if (!enter(request[0], request[1], request[2])) ::_exit(127);
  const auto variables = std::stoul(request[3]);
  std::size_t at = 4;
  ::clearenv();
  for (; at < 4 + variables; ++at) ::putenv(request[at].data());
  std::vector<const char*> words;
  for (; at < request.size(); ++at) words.push_back(request[at].c_str());
  std::exit(cli::run_program(static_cast<int>(words.size()), words.data()));
}

[[noreturn]] void serve(int end) {
  for (;;) {
    const ssize_t size = ::recv(end, nullptr, 0, MSG_PEEK | MSG_TRUNC);
    if (size <= 0) ::_exit(0);  // the requesting process is gone
    std::string request(static_cast<std::size_t>(size), '\0');
    ::recv(end, request.data(), request.size(), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(end);
      run(unpacked(request));
    }
    const Ended ended = wait_for(child);
    ::send(end, &ended, sizeof ended, MSG_NOSIGNAL);
  }
}

}  // namespace

void start_program_server() {
  int ends[2] = {};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
    throw std::runtime_error("no line to a server of runs");
  }
  if (::fork() == 0) {
    ::close(ends[0]);
    serve(ends[1]);
  }
  ::close(ends[1]);
  to_server() = ends[0];
}

Finished run_forked(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  const Logs logs;
  const std::vector<std::string> variables = environment();
  std::vector<std::string> request = {folder.path(), logs.out, logs.err,
                                      std::to_string(variables.size())};
  request.insert(request.end(), variables.begin(), variables.end());
  request.emplace_back("repose");
  request.insert(request.end(), arguments.begin(), arguments.end());
  const std::string text = packed(request);

  const Clock::time_point start = Clock::now();
  Ended ended;
  if (::send(to_server(), text.data(), text.size(), MSG_NOSIGNAL) != std::ssize(text) ||
      ::recv(to_server(), &ended, sizeof ended, 0) != sizeof ended) {
    throw std::runtime_error("the server of runs does not answer");
  }
  return finished(ended, logs, start);
}

}  // namespace repose::testing
