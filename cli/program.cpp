#include "cli/program.h"

#include <algorithm>
#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/freed_memory.h"
#include "base/input_error.h"
#include "base/memory.h"
#include "base/text.h"
#include "base/version.h"
#include "cli/board/board.h"
#include "cli/calibrate/calibrate_options.h"
#include "cli/camera/camera.h"
#include "cli/common/output.h"
#include "cli/compare/compare_options.h"
#include "cli/export/export.h"
#include "cli/help/help.h"
#include "cli/measure/measure_options.h"
#include "cli/new/new_study.h"
#include "cli/plan/plan.h"
#include "cli/render/render_options.h"
#include "cli/report/report.h"
#include "cli/runs/runs_commands.h"
#include "cli/shape/shape.h"
#include "cli/simulate/simulate_command.h"
#include "cli/statistics/statistics_commands.h"
#include "cli/studio/studio.h"
#include "cli/track/track.h"
#include "cli/verify/verify.h"

namespace repose::cli {

namespace {

/// The parsed command line: one of these.
struct Arguments {
  std::function<ExitCode()> run;  ///< runs the requested command
  base::FieldNames fields;        ///< of this command
  std::string text;               ///< requested help or version
  std::string error;              ///< why the command line is invalid, and how to fix it
};

constexpr int kOptionColumn = 32;  // where explanations begin in the help

/// A command and its CLI11 objects.
struct Registered {
  Command command;
  CLI::App* app = nullptr;
};

CLI::Option* add_to(CLI::App& app, const std::string& name, std::string& text) {
  return app.add_option(name, text);
}

CLI::Option* add_to(CLI::App& app, const std::string& name, std::vector<std::string>& texts) {
  CLI::Option* option = app.add_option(name, texts);
  // A list is given by repeating its option: words that follow belong to the command.
  return name.starts_with('-') ? option->allow_extra_args(false) : option;
}

CLI::Option* add_to(CLI::App& app, const std::string& name, bool& is_given) {
  return app.add_flag(name, is_given);
}

Registered registered(CLI::App& program, Command command) {
  CLI::App* app = program.add_subcommand(command.name, command.summary);
  app->get_formatter()->column_width(kOptionColumn);
  app->footer(command.notes);
  for (const CommandOption& option : command.options) {
    CLI::Option* added =
        std::visit([&](auto* target) { return add_to(*app, option.name, *target); }, option.target);
    added->description(option.help)->required(option.is_required);
    if (!option.value_name.empty()) added->option_text(option.value_name);
    if (option.word_count > 0) added->expected(option.word_count);
  }
  return {std::move(command), app};
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  return names;
}

/// The error for a word that is neither a command nor an option of `app`; `usage` is how to call
/// it.
std::string unknown_word(const CLI::App& app, const std::string& usage, const std::string& word) {
  const bool is_option = word.starts_with('-');
  const auto known = is_option ? option_names(app) : command_names(app);
  const std::string guess = base::closest_word(word.substr(0, word.find('=')), known);
  return fmt::format("{}: unknown {} of {}. {}Fix: see {} --help.", word,
                     is_option ? "option" : "command", usage,
                     guess.empty() ? "" : fmt::format("Did you mean {}? ", guess), usage);
}

std::string error_of(const CLI::App& app, const Registered* parsed, const CLI::ParseError& error) {
  const CLI::App& active = parsed ? *parsed->app : app;
  const std::string usage = parsed ? "repose " + parsed->command.name : "repose";
  const auto unknown = active.remaining();
  if (!unknown.empty()) {
    const auto option = std::find_if(unknown.begin(), unknown.end(),
                                     [](const std::string& word) { return word.starts_with('-'); });
    return unknown_word(active, usage, option == unknown.end() ? unknown.front() : *option);
  }
  if (parsed && dynamic_cast<const CLI::RequiredError*>(&error)) {
    return parsed->command.name + ": " + parsed->command.missing;
  }
  return fmt::format("{}. Fix: see {} --help.", error.what(), usage);
}

/// An option with an empty value is not the same as an omitted one.
std::string empty_value(const Registered& parsed) {
  for (const CLI::Option* option : parsed.app->get_options()) {
    const auto& given = option->results();
    if (std::find(given.begin(), given.end(), "") == given.end()) continue;
    const std::string name = option->get_name();
    const std::string typed = option->get_positional() ? "" : name + ' ';
    return fmt::format("{} {}: no value given. Fix: give {}{}{}.", parsed.command.name, name, typed,
                       option->get_option_text(),
                       option->get_required() ? "" : ", or leave it out");
  }
  return {};
}

Arguments parse_arguments(int count, const char* const* words) {
  CLI::App app(kAbout, "repose");
  app.set_version_flag("--version", base::kProgram);
  app.footer(kExamples);
  app.get_formatter()->column_width(kOptionColumn);
  std::vector<Registered> commands;
  for (Command& command : all_commands()) commands.push_back(registered(app, std::move(command)));
  const auto parsed = [&commands]() -> const Registered* {
    const auto found = std::find_if(commands.begin(), commands.end(),
                                    [](const Registered& one) { return one.app->parsed(); });
    return found == commands.end() ? nullptr : &*found;
  };

  Arguments arguments;
  try {
    app.parse(count, words);
    if (const Registered* found = parsed()) {
      arguments.error = empty_value(*found);
      arguments.run = found->command.run;
      arguments.fields = found->command.fields;
    } else {
      arguments.text = app.help();
    }
  } catch (const CLI::CallForHelp&) {
    arguments.text = app.help();
  } catch (const CLI::CallForVersion& version) {
    arguments.text = std::string(version.what()) + '\n';
  } catch (const CLI::ParseError& error) {
    arguments.error = error_of(app, parsed(), error);
  }
  return arguments;
}

}  // namespace

std::vector<Command> all_commands() {
  std::vector<Command> commands = {
      measure_command(), board_command(),   camera_command(),    compare_command(),
      track_command(),   shape_command(),   simulate_command(),  render_command(),
      new_command(),     plan_command(),    calibrate_command(), report_command(),
      export_command(),  predict_command(), ask_command(),       bench_command(),
      design_command(),  regress_command(), verify_command(),    studio_command()};
  const std::vector<Command> of_help = help_commands(commands);
  commands.insert(commands.end(), of_help.begin(), of_help.end());
  return commands;
}

namespace {

/// Reports unexpected exceptions.
ExitCode report(const std::exception& error, const std::string& command) {
  if (base::is_out_of_memory(error)) {
    print_line(
        base::no_memory(command,
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
  base::disable_heap_trimming();
  return static_cast<int>(
      carry_out([&] { return run(count, words); }, count > 1 ? words[1] : "repose", {}));
}

}  // namespace repose::cli
