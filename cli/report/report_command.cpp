#include "cli/report/report_command.h"

#include <memory>

#include "cli/report/report.h"

namespace repose::cli {
namespace {

constexpr const char* kNotes = R"(
FOLDER is what repose calibrate --out wrote. The page needs no other file and
no network: it can be sent by e-mail, printed on A4, and read on a phone. It
begins with the coefficients and shows how they were found. A study without a
result yet gets a page that says so. Photographs that the study names are
measured again; missing ones are listed.

The tables hold the numbers of every chart, as CSV.

Examples:
  repose report study_calibration
  repose report hazelnut --out hazelnut.html --tables none
)";

}  // namespace

Command report_command() {
  const auto given = std::make_shared<ReportArguments>();
  return {
      .name = "report",
      .summary = "Write a page about a calibrated study",
      .options = {{"folder", "FOLDER", "What repose calibrate --out wrote", &given->folder, true},
                  {"--out", "FILE.html", "The page (FOLDER/report.html)", &given->out_file},
                  {"--tables", "FOLDER|none", "Its numbers (FOLDER/tables)",
                   &given->tables_folder}},
      .notes = kNotes,
      .missing =
          "no folder is named. Fix: repose report FOLDER, the one of repose calibrate --out.",
      .run = [given] { return run_report(*given); }};
}

}  // namespace repose::cli
