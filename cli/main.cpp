#include <exception>
#include <stdexcept>

#include <fmt/format.h>

#include "cli/arguments.h"
#include "cli/common/exit_code.h"
#include "cli/common/output.h"

namespace repose::cli {
namespace {

ExitCode run(int count, const char* const* words) {
  const Arguments arguments = parse_arguments(count, words);
  if (!arguments.error.empty()) {
    fmt::print(stderr, "repose: {}\n", arguments.error);
    return ExitCode::bad_input;
  }
  if (arguments.run) {
    try {
      return arguments.run();
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(naming_options(error.what(), arguments.option_names));
    }
  }
  write_output(std::string(kStandardOutput), arguments.text);
  return ExitCode::done;
}

}  // namespace
}  // namespace repose::cli

int main(int count, char** words) {
  using repose::cli::ExitCode;
  ExitCode code = ExitCode::internal_error;
  try {
    code = repose::cli::run(count, words);
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "repose: {}\n", error.what());
    code = ExitCode::bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "repose: internal error: {}. Fix: please report it.\n", error.what());
  }
  return static_cast<int>(code);
}
