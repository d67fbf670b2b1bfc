#include "cli/report/report_command.h"

#include <memory>

#include "cli/report/report.h"

namespace repose::cli {
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
