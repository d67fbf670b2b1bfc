#include "cli/export/export.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/text.h"
#include "calibrate/export/export.h"
#include "calibrate/result/result.h"
#include "calibrate/study/study_record.h"
#include "cli/calibrate/calibrate_table.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/table.h"
#include "cli/common/terminal.h"

namespace repose::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using calibrate::Conversion;
using calibrate::StudyExport;

/// A complete export, before its output.
struct ExportPlan {
  calibrate::ExportRequest request;
  fs::path out_folder;
  StudyExport made;
  std::vector<std::vector<double>> sets;  ///< all that could be exported
  std::vector<std::string> errors;        ///< empty: it can be carried out
};

std::string known_targets() {
  std::string names;
  for (const calibrate::ExportTarget target : calibrate::export_targets()) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", name_of(target));
  }
  return names;
}

StudyExport export_of(const fs::path& folder, const calibrate::ExportRequest& request,
                      std::vector<std::vector<double>>& sets) {
  const calibrate::StudyRecord record = calibrate::read_study_record(folder);
  const auto result = calibrate::read_result(folder);
  if (result && !is_same_study(result->provenance.study, identity_of(record))) {
    base::refuse(
        folder,
        fmt::format(
            "{} does not belong to the study in {}: the study was changed, and is unfinished",
            calibrate::kResultFile, calibrate::kNotesFile),
        "run the same repose calibrate command again; it resumes.");
  }
  if (!result) {
    base::refuse(folder, "contains no result.json: the study is unfinished",
                 "run the same repose calibrate command again; it resumes.");
  }
  if (is_provisional(*result)) {
    base::refuse(folder, "its result is provisional: the study was interrupted",
                 "run the same repose calibrate command again; it resumes.");
  }
  sets = calibrate::exported_sets(*result);
  StudyExport made =
      calibrate::export_study(record.study, record.grain.shape, calibrate::fitted_values(*result),
                              request, sets, calibrate::bench_means_of(*result));
  const std::string shape = dem::warning_of_shape(record.grain);
  if (!shape.empty()) made.warnings.push_back(shape);
  return made;
}

ExportPlan plan_export(const ExportArguments& arguments) {
  ExportPlan plan;
  const calibrate::ExportTarget target = calibrate::export_target_named(arguments.target);
  if (target == nullptr) {
    plan.errors.push_back(fmt::format("--to {}: must be one of {}. Fix: --to liggghts.",
                                      arguments.target, known_targets()));
  }
  std::vector<fs::path> read;
  for (const char* name : {calibrate::kStudyCopy, calibrate::kClumpCopy, calibrate::kNotesFile,
                           calibrate::kResultFile, calibrate::kHeapFile}) {
    read.push_back(fs::path(arguments.folder) / name);
  }
  check_output_places({json_place(arguments.json_file, "\"conversions\"")}, read, plan.errors);
  plan.request = {.target = target != nullptr ? target : calibrate::liggghts_target(),
                  .takes_approximate = arguments.takes_approximate || target == nullptr};
  constexpr int kMaxSets = 1000;
  if (const auto number = read_whole_number({"--set-number", arguments.set_number, plan.errors}, 1,
                                            kMaxSets, "leave it out for the best set, number 1")) {
    plan.request.set_number = static_cast<std::size_t>(*number);
  }
  plan.out_folder = arguments.out_folder.empty()
                        ? fs::path(arguments.folder) / "export" / arguments.target
                        : fs::path(arguments.out_folder);
  try {
    plan.made = export_of(arguments.folder, plan.request, plan.sets);
  } catch (const base::InputError& error) {
    add_faults(error, plan.errors);
  }
  return plan;
}

std::string export_json(const ExportPlan& plan) {
  Json json{{"target", name_of(plan.request.target)}, {"folder", plan.out_folder.string()}};
  json["files"] = Json::array();
  for (const auto& file : plan.made.files) json["files"].push_back(file.name);
  json["conversions"] = Json::array();
  for (const Conversion& conversion : plan.made.conversions) {
    json["conversions"].push_back({{"coefficient", conversion.coefficient},
                                   {"value", conversion.value},
                                   {"target_name", conversion.target_name},
                                   {"exported", conversion.exported},
                                   {"standing", name_of(conversion.fidelity)},
                                   {"ours", conversion.ours},
                                   {"theirs", conversion.theirs},
                                   {"limits", conversion.limits}});
  }
  json["set_number"] = plan.request.set_number;
  json["sets"] = Json::array();
  for (const std::vector<double>& set : plan.sets) json["sets"].push_back(set);
  json["warnings"] = plan.made.warnings;
  constexpr int kNoteIndent = 2;
  // Folder names need not be UTF-8, but JSON must be.
  return json.dump(kNoteIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string export_table(const ExportPlan& plan, int columns) {
  Table table({{.heading = "coefficient"},
               number_column("ours"),
               number_column("theirs"),
               {.heading = "conversion"}});
  for (const Conversion& conversion : plan.made.conversions) {
    table.add_row({short_name(conversion.coefficient), fmt::format("{:.4g}", conversion.value),
                   fmt::format("{:.4g}", conversion.exported), name_of(conversion.fidelity)});
  }
  return table.text(columns) +
         fmt::format("\n{}: {} files{}.\nREADME.txt says what carries over and what does not.\n",
                     base::printable(plan.out_folder.string()), plan.made.files.size(),
                     plan.sets.size() < 2
                         ? ""
                         : fmt::format(", of set {} of {} that fit equally well; use one together",
                                       plan.request.set_number, plan.sets.size()));
}

}  // namespace

ExitCode run_export(const ExportArguments& arguments) {
  // A signal is only handled once nothing is half done.
  const std::atomic<bool>& is_interrupted = watch_for_interrupt();
  const ExportPlan plan = plan_export(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  if (is_interrupted) {
    print_line("interrupted, nothing was exported");
    return ExitCode::interrupted;
  }
  calibrate::write_export(plan.out_folder, plan.made.files, arguments.out_folder.empty());
  Outputs outputs;
  outputs.add(arguments.json_file, export_json(plan));
  outputs.show(export_table(plan, columns_of(stdout)));
  outputs.write_files();
  print_lines(plan.made.warnings);
  outputs.write();
  return ExitCode::done;
}

namespace {

constexpr const char* kExportNotes = R"(
FOLDER is the output folder of repose calibrate. Material, contacts, clump and a
deck for each experiment are written to FOLDER/export/PROGRAM, with a README.txt
that gives both programs' definitions of each coefficient.

Programs:
{}
Rolling friction is defined differently in each. A coefficient with an exact or
nearly exact counterpart is converted. If the law differs, the export is refused
with the reason; --approximate writes the value that is equivalent on average.

Where coefficients are not determined, several sets of them fit equally well. The
best is written; --set-number 2 writes another. README.txt lists them all. Use
the values of one set together.

Example:
  repose export hazelnut --to yade --approximate
)";

std::string export_notes() {
  std::string programs;
  for (const calibrate::ExportTarget target : calibrate::export_targets()) {
    programs += fmt::format("  {:<12}{}\n", name_of(target), summary_of(target));
  }
  return fmt::format(kExportNotes, programs);
}

}  // namespace

Command export_command() {
  const auto given = std::make_shared<ExportArguments>();
  return {
      .name = "export",
      .summary = "Export a calibrated study to another program",
      .options = {{"folder", "FOLDER", "Folder of a finished study", &given->folder, true},
                  {"--to", "PROGRAM", "Program to export to", &given->target, true},
                  {"--approximate", "", "Allow approximate conversions", &given->takes_approximate},
                  {"--set-number", "N", "Which of the equally good sets (1, the best)",
                   &given->set_number},
                  {"--out", "FOLDER", "Output folder (FOLDER/export/PROGRAM)", &given->out_folder},
                  {"--json", "FILE|-", "Files and conversions, for programs", &given->json_file}},
      .notes = export_notes(),
      .missing =
          "a study's folder and a program are needed. Fix: repose export FOLDER --to liggghts.",
      .run = [given] { return run_export(*given); }};
}

}  // namespace repose::cli
