#include "cli/board/board_command.h"

#include <memory>

#include "cli/board/board.h"

namespace repose::cli {
namespace {

constexpr const char* kBoardNotes = R"(
A board to print, which gives pictures a scale, and cameras their pitch and lens:
a chessboard of 10 x 7 squares of 24 mm with a marker in each white one (ChArUco,
DICT_4X4_50, markers of 18 mm). FILE ends in .pdf, or in .png.

Print it at 100 % ("actual size", not "fit to page") and measure the line below
it: it must be 100 mm long. If a printer cannot do that, measure ten squares and
give a tenth of that as --square-mm. Glue the sheet to a flat, stiff plate.

Examples:
  repose board --out board.pdf
  repose camera board_photos --out camera.toml
  repose measure heap.jpg --board --camera-file camera.toml
)";

}  // namespace

Command board_command() {
  const auto given = std::make_shared<BoardArguments>();
  return {
      .name = "board",
      .summary = "Print a board for scale, camera and lens",
      .options = {{"--out", "FILE.pdf|FILE.png", "Where the page goes", &given->out_file, true},
                  {"--paper", "a4|letter", "Size of the paper, on its side (a4)", &given->paper},
                  {"--dpi", "N", "Of a PNG: pixels per inch (300)", &given->dpi}},
      .notes = kBoardNotes,
      .missing = "no file is named. Fix: repose board --out board.pdf.",
      .run = [given] { return run_board(*given); }};
}

}  // namespace repose::cli
