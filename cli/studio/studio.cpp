#include "cli/studio/studio.h"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"
#include "studio/server.h"

namespace repose::cli {

namespace {

/// The arguments as typed.
struct StudioArguments {
  std::string folder = ".";
  std::string port;
  bool opens_no_browser = false;
};

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != 0;
}

/// The command that opens an address on this desktop; empty: none. Under WSL it opens in Windows.
std::vector<std::string> opener() {
  if (is_set("WSL_DISTRO_NAME")) {
    return {"powershell.exe", "-NoProfile", "-Command", "Start-Process"};
  }
  if (is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")) return {"xdg-open"};
  return {};
}

/// The address is printed as well, in case no browser opens.
void open_browser(const std::string& address) {
  std::vector<std::string> words = opener();
  if (words.empty()) return;
  words.push_back(address);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  // Hide the browser's own messages.
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", 1, 0);
  posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", 1, 0);
  pid_t ignored = 0;
  posix_spawnp(&ignored, arguments.front(), &quiet, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
}

ExitCode run_studio(const StudioArguments& arguments) {
  constexpr int kLowest = 1024, kHighest = 65535;
  std::vector<std::string> errors;
  const auto port =
      read_number_within({"--port", arguments.port, errors}, kLowest, kHighest, "--port 8080");
  print_lines(errors);
  if (!errors.empty()) return ExitCode::bad_input;
  const std::atomic<bool>& is_interrupted = watch_for_interrupt();
  studio::Server server({.folder = arguments.folder,
                         .port = static_cast<int>(port.value_or(0)),
                         .program = std::filesystem::read_symlink("/proc/self/exe")});
  fmt::print("{}\n", server.address());
  std::fflush(stdout);
  print_line("open this address in a browser on this machine; Ctrl-C ends the studio");
  if (!arguments.opens_no_browser) open_browser(server.address());
  std::jthread ending([&](const std::stop_token& ended) {
    using namespace std::chrono_literals;
    while (!is_interrupted && !ended.stop_requested()) std::this_thread::sleep_for(100ms);
    server.stop();
  });
  server.run();
  return ExitCode::done;
}

constexpr const char* kStudioNotes = R"(
A page in your browser for viewing, correcting and summarising pictures, films
and scans of heaps, and for starting, filling in and calibrating studies. Each
step shows the command line that does the same. FOLDER holds the files (the
current folder if left out). Corrections are saved beside the pictures, as
repose measure --save-hints does; a calibration continues when the page is
closed, and stops in good order with the studio.

The page is for this machine alone: it cannot be reached from another machine or
from other pages in the same browser, and it needs no network. The address
that is printed contains a key: whoever has it can do all that the page can do.

Examples:
  repose studio photos
  repose studio photos --no-browser --port 8080
)";

}  // namespace

Command studio_command() {
  const auto given = std::make_shared<StudioArguments>();
  return {
      .name = "studio",
      .summary = "Look at heaps and do studies in the browser",
      .options = {{"folder", "[FOLDER]", "With your pictures, films and scans (.)", &given->folder},
                  {"--no-browser", "", "Only print the address", &given->opens_no_browser},
                  {"--port", "N", "1024 to 65535 (one that is free)", &given->port}},
      .notes = kStudioNotes,
      .run = [given] { return run_studio(*given); }};
}

}  // namespace repose::cli
