#include "cli/calibrate/calibrate_runs.h"

#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "calibrate/result/result.h"
#include "calibrate/runs/table_fit.h"
#include "calibrate/study/study_record.h"
#include "cli/calibrate/calibrate_engine.h"
#include "cli/calibrate/calibrate_table.h"
#include "cli/common/terminal.h"

namespace repose::cli {
ExitCode run_calibrate_runs(const CalibrateArguments& arguments) {
  calibrate::TableRequest request{.study = arguments.study,
                                  .settings = arguments.settings,
                                  .runs = {arguments.runs.begin(), arguments.runs.end()},
                                  .folder = arguments.out_folder};
  if (request.folder.empty()) request.folder = calibrate::default_folder(request.study);
  std::vector<std::string> errors;
  refuse_simulations(arguments, "--runs", errors);
  for (const auto& [is_given, option] :
       {std::pair(!arguments.jobs.empty(), "--jobs"), std::pair(arguments.is_dry_run, "--dry-run"),
        std::pair(!arguments.max_runs.empty(), "--max-runs")}) {
    if (!is_given) continue;
    errors.push_back(fmt::format(
        "{}: is of runs that are to be made, and with --runs none is, without [engine] in the "
        "study. Fix: leave one of them out.",
        option));
  }
  std::vector<std::filesystem::path> read = request.runs;
  read.push_back(request.study);
  for (const char* name : {calibrate::kStudyCopy, calibrate::kNotesFile, calibrate::kResultFile}) {
    read.push_back(request.folder / name);
  }
  check_output_places({json_place(arguments.json_file, "\"hash\"")}, read, errors);
  print_lines(errors);
  if (!errors.empty()) return ExitCode::bad_input;
  const auto result = calibrate::calibrate_table(request, print_line, watch_for_interrupt());
  if (!result) {
    print_line("interrupted; no result was written.");
    return ExitCode::interrupted;
  }
  Outputs outputs;
  outputs.add(arguments.json_file, to_json(*result));
  outputs.show(joint_table(std::get<calibrate::JointResult>(result->found), result->provenance,
                           columns_of(stdout)));
  outputs.write();
  return ExitCode::done;
}

}  // namespace repose::cli
