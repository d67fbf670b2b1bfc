#include "cli/program.h"

#include <exception>
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

ExitCode run(int count, const char* const* words) {
  const Arguments arguments = parse_arguments(count, words);
  if (!arguments.error.empty()) {
    print_line(arguments.error);
    return ExitCode::bad_input;
  }
  if (arguments.run) return carry_out(arguments.run, words[1], arguments.fields);
  Outputs outputs;
  outputs.show(arguments.text);
  outputs.write();
  return ExitCode::done;
}

}  // namespace

ExitCode carry_out(const std::function<ExitCode()>& work, const std::string& command,
                   base::FieldNames fields) {
  try {
    return work();
  } catch (const base::InputError& error) {
    std::vector<std::string> lines;
    add_faults(error, lines, fields);
    print_lines(lines);
    return ExitCode::bad_input;
  } catch (const std::exception& error) {
    return report(error, command);
  }
}

int run_program(int count, const char* const* words) {
  prepare_streams();
  base::keep_freed_memory();
  return static_cast<int>(
      carry_out([&] { return run(count, words); }, count > 1 ? words[1] : "repose", {}));
}

}  // namespace repose::cli
