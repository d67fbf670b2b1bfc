#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/arguments.h"
#include "cli/common/exit_code.h"
#include "cli/common/output.h"

namespace repose::cli {
namespace {

ExitCode run(int count, const char* const* words) {
  const Arguments arguments = parse_arguments(count, words);
  if (!arguments.error.empty()) {
    print_line(arguments.error);
    return ExitCode::bad_input;
  }
  if (arguments.run) {
    try {
      return arguments.run();
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(naming_options(error.what(), arguments.option_names));
    }
  }
  Outputs outputs;
  outputs.show(arguments.text);
  outputs.write();
  return ExitCode::done;
}

}  // namespace
}  // namespace repose::cli

int main(int count, char** words) {
  using repose::cli::ExitCode;
  repose::cli::prepare_streams();
  ExitCode code = ExitCode::internal_error;
  try {
    code = repose::cli::run(count, words);
  } catch (const std::invalid_argument& error) {
    std::vector<std::string> lines;
    repose::cli::add_lines(error.what(), lines);
    repose::cli::print_lines(lines);
    code = ExitCode::bad_input;
  } catch (const std::exception& error) {
    repose::cli::print_line(
        fmt::format("internal error: {}. Fix: please report it.", error.what()));
  }
  return static_cast<int>(code);
}
