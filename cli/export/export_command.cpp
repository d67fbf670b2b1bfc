#include "cli/export/export_command.h"

#include <memory>

#include "cli/export/export.h"

namespace repose::cli {
namespace {

constexpr const char* kExportNotes = R"(
FOLDER is the output folder of repose calibrate. Material, contacts, clump and a
deck for each experiment are written to FOLDER/export/PROGRAM, with a README.txt
that gives both programs' definitions of each coefficient.

Programs:
  liggghts    decks for all experiments but fills that are tapped
  yade        scripts for drop, tilt, roll and heap
  lammps      decks for drop, tilt and roll
  edem        tables to type in

Rolling friction is defined differently in each. A coefficient with an exact or
nearly exact counterpart is converted. If the law differs, the export is refused
with the reason; --approximate writes the value that is equivalent on average.

Where coefficients are not determined, several sets of them fit equally well. The
best is written; --set-number 2 writes another. README.txt lists them all. Use
the values of one set together.

Example:
  repose export hazelnut --to yade --approximate
)";

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
      .notes = kExportNotes,
      .missing =
          "a study's folder and a program are needed. Fix: repose export FOLDER --to liggghts.",
      .run = [given] { return run_export(*given); }};
}

}  // namespace repose::cli
