#include "cli/arguments.h"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/suggestion.h"

namespace repose::cli {
namespace {

constexpr const char* kAbout = "Measures the angle of repose of granular heaps from photographs.";

constexpr const char* kExamples = R"(
Examples:
  repose measure heap.jpg
  repose measure photos/ --overlay checked/ --csv angles.csv
  repose measure photos/ --method paper --json -

Exit codes: 0 done, 1 internal error, 2 bad usage or input,
3 nothing measurable, 130 interrupted.
)";

constexpr const char* kMeasureNotes = R"(
PICTURE is a level side view: JPEG, PNG, TIFF, BMP or WebP. A folder stands
for the pictures in it. FILE may be - for standard output.

Methods:
  auto   Several ways to part the heap from its background are tried and the
         most convincing silhouette is taken. Its ground line is found; thin
         aprons at the toe, the crest and stray grains are left out. A robust
         line is fitted to each side within the window. Angles are measured
         from the ground line.
  paper  The chain of the published hazelnut study: grey picture, Otsu
         threshold, holes filled, edge, ordinary least squares through each
         side's edge over the whole window, mean of the two sides' absolute
         slopes.

Window: the stretch of each side that is fitted, in parts of the heap's
height. Sides are hollow at the toe and round at the crest, so the window is
part of the result: always state it. The other definitions in use (height
over base, half-height tangent, whole flank, other windows) are listed by
--definitions and in the JSON.

Uncertainties are half-widths of 95 % intervals. Several pictures give a mean
of those with status ok. A number with status flagged has a warning that a
person must look at; a refused picture has a reason instead of a number.
)";

CLI::App* add_measure(CLI::App& app, MeasureArguments& arguments) {
  CLI::App* measure = app.add_subcommand("measure", "Measure heaps in pictures");
  measure->add_option("pictures", arguments.pictures, "Pictures, or folders of pictures")
      ->option_text("PICTURE|FOLDER ...")
      ->required();
  measure->add_option("--method", arguments.method, "How to measure (auto)")
      ->option_text("auto|paper");
  measure->add_option("--window", arguments.window, "Part of the height (0.2,0.8)")
      ->option_text("FROM,TO");
  measure->add_option("--exclude", arguments.exclude, "Box in pixels to leave out; repeatable")
      ->option_text("X,Y,W,H")
      ->allow_extra_args(false);
  measure->add_option("--pitch-deg", arguments.pitch_deg, "Camera's downward pitch (0)")
      ->option_text("DEGREES");
  measure->add_option("--overlay", arguments.overlay_folder, "Draw what was measured")
      ->option_text("FOLDER");
  measure->add_option("--json", arguments.json_file, "Everything, for programs")
      ->option_text("FILE|-");
  measure->add_option("--csv", arguments.csv_file, "A row for each picture")->option_text("FILE|-");
  measure->add_option("--summary", arguments.summary_file, "Mean and interval, as JSON")
      ->option_text("FILE|-");
  measure->add_option("--threads", arguments.threads, "Pictures at a time (all cores)")
      ->option_text("N");
  measure->add_flag("--definitions", arguments.shows_definitions, "List other definitions too");
  measure->footer(kMeasureNotes);
  return measure;
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

/// What to do about a word that is no command and no option of `app`, which `usage` calls.
std::string unknown_word(const CLI::App& app, const std::string& usage, const std::string& word) {
  const bool is_option = word.starts_with('-');
  const auto known = is_option ? option_names(app) : command_names(app);
  const std::string guess = closest(word.substr(0, word.find('=')), known);
  return fmt::format("{} is no {} of {}. {}Fix: see {} --help.", word,
                     is_option ? "option" : "command", usage,
                     guess.empty() ? "" : fmt::format("Did you mean {}? ", guess), usage);
}

std::string fault_of(const CLI::App& app, const CLI::App& measure, const CLI::ParseError& error) {
  const CLI::App& active = measure.parsed() ? measure : app;
  const std::string usage = measure.parsed() ? "repose measure" : "repose";
  const auto unknown = active.remaining();
  if (!unknown.empty()) {
    const auto option = std::find_if(unknown.begin(), unknown.end(),
                                     [](const std::string& word) { return word.starts_with('-'); });
    return unknown_word(active, usage, option == unknown.end() ? unknown.front() : *option);
  }
  if (dynamic_cast<const CLI::RequiredError*>(&error)) {
    return "measure: no picture is named. Fix: repose measure PICTURE, or a folder of pictures.";
  }
  return fmt::format("{}. Fix: see {} --help.", error.what(), usage);
}

}  // namespace

Arguments parse_arguments(int count, const char* const* words) {
  MeasureArguments measure_arguments;
  CLI::App app(kAbout, "repose");
  app.set_version_flag("--version", "repose " REPOSE_VERSION);
  app.footer(kExamples);
  app.get_formatter()->column_width(32);
  CLI::App* measure = add_measure(app, measure_arguments);
  measure->get_formatter()->column_width(32);

  Arguments arguments;
  try {
    app.parse(count, words);
    if (measure->parsed()) {
      arguments.measure = measure_arguments;
    } else {
      arguments.text = app.help();
    }
  } catch (const CLI::CallForHelp&) {
    arguments.text = app.help();
  } catch (const CLI::CallForVersion& version) {
    arguments.text = std::string(version.what()) + '\n';
  } catch (const CLI::ParseError& error) {
    arguments.fault = fault_of(app, *measure, error);
  }
  return arguments;
}

}  // namespace repose::cli
