#include "cli/report/report.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "base/input_error.h"
#include "base/text.h"
#include "calibrate/report/study_report.h"
#include "calibrate/study/study_record.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"

namespace repose::cli {

namespace {

namespace fs = std::filesystem;

/// The files a page is made from, which must not be overwritten.
std::vector<fs::path> files_read(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const char* name : {calibrate::kStudyCopy, calibrate::kClumpCopy, calibrate::kNotesFile,
                           calibrate::kResultFile, calibrate::kHeapFile}) {
    files.push_back(folder / name);
  }
  std::error_code error;
  for (fs::directory_iterator entry(folder / "runs", error), end; !error && entry != end;
       entry.increment(error)) {
    files.push_back(entry->path());
  }
  if (const auto notes = calibrate::read_study_notes(folder)) {
    for (const calibrate::PictureReading& picture : notes->measurement.pictures)
      files.push_back(picture.file);
    for (const calibrate::FilmReading& film : notes->measurement.films) files.push_back(film.file);
  }
  return files;
}

/// Checks before the long work that the page and its tables can be written.
void check_places(const fs::path& folder, const fs::path& page, const fs::path& tables) {
  std::vector<std::string> errors;
  check_output_places({page_place("--out", page.string())}, files_read(folder), errors);
  if (!tables.empty()) make_output_folder("--tables", tables, errors);
  base::Faults faults;
  for (const std::string& error : errors) faults.add({.value = error});
  faults.throw_if_any();
}

}  // namespace

ExitCode run_report(const ReportArguments& arguments) {
  // A signal is only handled once nothing is half done.
  const std::atomic<bool>& is_interrupted = watch_for_interrupt();
  const fs::path folder = arguments.folder;
  const fs::path page =
      arguments.out_file.empty() ? folder / "report.html" : fs::path(arguments.out_file);
  fs::path tables =
      arguments.tables_folder.empty() ? folder / "tables" : fs::path(arguments.tables_folder);
  if (arguments.tables_folder == "none") tables.clear();
  std::error_code ignored;
  if (fs::is_directory(folder, ignored)) check_places(folder, page, tables);
  const calibrate::report::Report report = calibrate::report::study_report(folder);
  if (is_interrupted) {
    print_line("interrupted, no report was written");
    return ExitCode::interrupted;
  }
  write_report(report, page, tables, arguments.tables_folder.empty());
  Outputs outputs;
  outputs.show(base::printable(page.string()) + '\n');
  outputs.write();
  return ExitCode::done;
}

namespace {

constexpr const char* kReportNotes = R"(
FOLDER is the output folder of repose calibrate. The report is a single file that
needs no network: it can be sent by e-mail, printed on A4, and read on a phone.
It begins with the coefficients and shows how they were found. An unfinished
study gets a page that says so. Photographs named in the study are measured
again; missing ones are listed.

The tables are the data of every chart, as CSV.

Examples:
  repose report study_calibration
  repose report hazelnut --out hazelnut.html --tables none
)";

}  // namespace

Command report_command() {
  const auto given = std::make_shared<ReportArguments>();
  return {
      .name = "report",
      .summary = "Write the report of a calibrated study",
      .options = {{"folder", "FOLDER", "Output folder of repose calibrate", &given->folder, true},
                  {"--out", "FILE.html", "Report (FOLDER/report.html)", &given->out_file},
                  {"--tables", "FOLDER|none", "Its data as CSV (FOLDER/tables)",
                   &given->tables_folder}},
      .notes = kReportNotes,
      .missing =
          "no folder given. Fix: repose report FOLDER, the output folder of repose calibrate.",
      .run = [given] { return run_report(*given); }};
}

}  // namespace repose::cli
