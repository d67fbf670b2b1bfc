#include "cli/export/export_command.h"

#include <memory>

#include "cli/export/export.h"

namespace repose::cli {
namespace {

constexpr const char* kNotes = R"(
FOLDER is what repose calibrate --out wrote. Material, contacts, clump and a
deck for each experiment go to FOLDER/export/PROGRAM, with a README.txt that
explains for each coefficient what it means here and there.

Programs:
  liggghts    decks for drop, tilt, roll and heap
  yade        the same, as scripts
  lammps      decks for drop, tilt and roll
  edem        tables to type in

Rolling friction means something different in each. A coefficient that has an
exact or nearly exact counterpart is converted. Where the law differs, the
export is refused with the reason; --approximate writes the value that is
equivalent on average.

Example:
  repose export hazelnut --to yade --approximate
)";

}  // namespace

Command export_command() {
  const auto given = std::make_shared<ExportArguments>();
  return {
      .name = "export",
      .summary = "Write a calibrated study for other programs",
      .options = {{"folder", "FOLDER", "Folder of a finished study", &given->folder, true},
                  {"--to", "PROGRAM", "For which program", &given->target, true},
                  {"--approximate", "", "Convert what has no exact counterpart",
                   &given->takes_approximate},
                  {"--out", "FOLDER", "Decks (FOLDER/export/PROGRAM)", &given->out_folder},
                  {"--json", "FILE|-", "Files and conversions, for programs", &given->json_file}},
      .notes = kNotes,
      .missing =
          "a study's folder and a program are needed. Fix: repose export FOLDER --to liggghts.",
      .run = [given] { return run_export(*given); }};
}

}  // namespace repose::cli
