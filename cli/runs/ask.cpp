#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "calibrate/runs/next_runs.h"
#include "calibrate/runs/table_runs.h"
#include "calibrate/runs/table_study.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/table.h"
#include "cli/common/terminal.h"
#include "cli/runs/runs_commands.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;

/// The arguments of `repose ask`, as typed.
struct AskArguments {
  std::string study;
  std::vector<std::string> runs;
  std::vector<std::string> settings;
  std::string count = "12";
  std::string out_file;
};

std::string table_of(const calibrate::TableStudy& study, const calibrate::NextRuns& next,
                     const std::string& file, int columns) {
  Page page(columns);
  if (!next.runs.empty()) {
    std::vector<Column> headings;
    for (const calibrate::Parameter& parameter : study.parameters) {
      headings.push_back(number_column(parameter.name));
    }
    headings.push_back({.heading = "reason"});
    Table table(std::move(headings));
    for (const calibrate::NextRun& run : next.runs) {
      std::vector<std::string> cells;
      for (const double value : run.values) cells.push_back(fmt::format("{:.6g}", value));
      cells.push_back(run.reason);
      table.add_row(std::move(cells));
    }
    page.add(table);
    page.add_gap();
    page.add(
        fmt::format("{} run{}, in {}: make {}, fill in the readings, and give both tables with "
                    "--runs.",
                    next.runs.size(), next.runs.size() == 1 ? "" : "s", file,
                    next.runs.size() == 1 ? "it" : "them"));
  }
  if (!next.left_out.empty()) page.add(next.left_out);
  for (const std::string& line : next.settled) page.add(line);
  return page.text();
}

/// Whether previously requested runs have been filled in; also true if the file cannot be read.
bool is_filled_in(const fs::path& file, const calibrate::TableStudy& study) {
  if (!fs::exists(file)) return false;
  try {
    return !calibrate::read_table_runs(study, {file}, calibrate::NoRows::allowed).runs.empty();
  } catch (const base::InputError&) {
    return true;
  }
}

ExitCode run_ask(const AskArguments& arguments) {
  std::vector<std::string> errors;
  constexpr int kMost = 1000;
  const auto count =
      read_whole_number({"--count", arguments.count, errors}, 1, kMost, "--count 12");
  std::vector<fs::path> read = {arguments.study};
  read.insert(read.end(), arguments.runs.begin(), arguments.runs.end());
  check_output_places({csv_place("--out", arguments.out_file, "reason")}, read, errors);
  print_lines(errors);
  if (!errors.empty()) return ExitCode::bad_input;
  const calibrate::TableStudy study =
      calibrate::read_table_study(arguments.study, arguments.settings);
  if (is_filled_in(arguments.out_file, study)) {
    base::refuse(arguments.out_file, "holds readings that were filled in",
                 "another name with --out; give this file with --runs.");
  }
  calibrate::TableRuns table;
  if (!arguments.runs.empty()) {
    table = calibrate::read_table_runs(study, {arguments.runs.begin(), arguments.runs.end()},
                                       calibrate::NoRows::allowed);
  }
  const calibrate::NextRuns next =
      calibrate::next_runs(study, table, static_cast<std::size_t>(count.value_or(1)));
  print_lines(table.notes);
  Outputs outputs;
  if (!next.runs.empty()) {
    outputs.add(arguments.out_file, csv_text(calibrate::next_runs_table(study, table, next.runs)));
  }
  outputs.show(table_of(study, next, arguments.out_file, columns_of(stdout)));
  outputs.write();
  return ExitCode::done;
}

constexpr const char* kAskNotes = R"(
Says which runs to make next with any program, for a study with [parameter] and
[measured]: while there are too few for a fit, runs that fill the bounds evenly;
then those that narrow the answer most, each with its reason. If further runs
would not narrow it, repose asks for fewer, or none, and says what would.

NEXT.csv has the columns of the first RUNS.csv, or else those of the study, with
the parameters filled in, and a column for the reason. It is not written if
there is nothing to ask for.

Examples:
  repose ask table.toml --count 12 --out next.csv
  repose ask table.toml --runs runs.csv --count 6 --out next.csv
)";

}  // namespace

Command ask_command() {
  const auto given = std::make_shared<AskArguments>();
  return {.name = "ask",
          .summary = "Choose the next runs of another program",
          .options = {{"study", "STUDY.toml", "Study file", &given->study, true},
                      {"--runs", "RUNS.csv", "Runs that there are; repeatable", &given->runs},
                      {"--count", "N", "At most so many (12)", &given->count},
                      {"--out", "NEXT.csv", "The runs, to be filled in", &given->out_file, true},
                      {"--set", "KEY=VALUE", "Replace a value of the study; repeatable",
                       &given->settings}},
          .notes = kAskNotes,
          .missing =
              "a study and a file for the runs are needed. Fix: repose ask STUDY.toml --out "
              "next.csv.",
          .run = [given] { return run_ask(*given); }};
}

}  // namespace repose::cli
