#include "cli/calibrate/calibrate_runs.h"

#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "calibrate/result/result.h"
#include "calibrate/runs/table_fit.h"
#include "calibrate/study/study_record.h"
#include "cli/calibrate/calibrate_table.h"
#include "cli/common/terminal.h"

namespace repose::cli {

void refuse_simulations(const CalibrateArguments& arguments, const char* what,
                        std::vector<std::string>& errors) {
  const CalibrateArguments usual;
  const auto refuse = [&](bool is_given, const char* option) {
    if (!is_given) return;
    errors.push_back(
        fmt::format("{}: is of simulations, and with {} none is made. Fix: leave one of them out.",
                    option, what));
  };
  refuse(arguments.budget != usual.budget, "--budget");
  refuse(!arguments.minutes.empty(), "--minutes");
  refuse(arguments.fidelity != usual.fidelity, "--fidelity");
  refuse(arguments.method != usual.method, "--method");
  refuse(!arguments.rolling_models.empty(), "--rolling-models");
  refuse(!arguments.progress_file.empty(), "--progress");
}

void check_json_place(const CalibrateArguments& arguments, const std::filesystem::path& folder,
                      std::vector<std::string>& errors) {
  std::vector<std::filesystem::path> read(arguments.runs.begin(), arguments.runs.end());
  read.emplace_back(arguments.study);
  for (const char* name : {calibrate::kStudyCopy, calibrate::kNotesFile, calibrate::kResultFile}) {
    read.push_back(folder / name);
  }
  check_output_places({json_place(arguments.json_file, "\"hash\"")}, read, errors);
}

void show_fit(const CalibrateArguments& arguments, const calibrate::StudyResult& result) {
  Outputs outputs;
  outputs.add(arguments.json_file, to_json(result));
  outputs.show(joint_table(std::get<calibrate::JointResult>(result.found), result.provenance,
                           columns_of(stdout)));
  outputs.write();
}

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
  check_json_place(arguments, request.folder, errors);
  print_lines(errors);
  if (!errors.empty()) return ExitCode::bad_input;
  const auto result = calibrate::calibrate_table(request, print_line, watch_for_interrupt());
  if (!result) {
    print_line("interrupted; no result was written.");
    return ExitCode::interrupted;
  }
  show_fit(arguments, *result);
  return ExitCode::done;
}

}  // namespace repose::cli
