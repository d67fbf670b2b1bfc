#include "cli/program.h"

#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/freed_memory.h"
#include "cli/arguments.h"
#include "cli/common/exit_code.h"
#include "cli/common/memory.h"
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

/// Says what nobody has foreseen.
ExitCode report(const std::exception& error, const std::string& command) {
  if (is_out_of_memory(error)) {
    print_line(no_memory(command,
                         "fewer --threads or --jobs at once, a smaller picture or scan, fewer "
                         "grains or frames"));
    return ExitCode::bad_input;
  }
  const std::string_view what = error.what();
  const bool has_fix = what.find("Fix: ") != std::string_view::npos;
  print_line(fmt::format("internal error: {}{}", what, has_fix ? "" : ". Fix: please report it."));
  return ExitCode::internal_error;
}

}  // namespace

int run_program(int count, const char* const* words) {
  prepare_streams();
  base::keep_freed_memory();
  ExitCode code = ExitCode::internal_error;
  try {
    code = run(count, words);
  } catch (const std::invalid_argument& error) {
    std::vector<std::string> lines;
    add_lines(error.what(), lines);
    print_lines(lines);
    code = ExitCode::bad_input;
  } catch (const std::exception& error) {
    code = report(error, count > 1 ? words[1] : "repose");
  }
  return static_cast<int>(code);
}

}  // namespace repose::cli
