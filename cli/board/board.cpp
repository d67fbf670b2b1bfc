#include "cli/board/board.h"

#include <memory>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "vision/camera/board.h"

namespace repose::cli {

namespace {

enum class PageFormat { pdf, png };

constexpr double kUsualDpi = 300;

struct BoardPlan {
  vision::Paper paper = vision::Paper::a4;
  PageFormat format = PageFormat::pdf;
  double dpi = kUsualDpi;
  std::vector<std::string> errors;
};

BoardPlan plan_board(const BoardArguments& arguments) {
  BoardPlan plan;
  plan.paper =
      read_choice<vision::Paper>({"--paper", arguments.paper, plan.errors},
                                 {{"a4", vision::Paper::a4}, {"letter", vision::Paper::letter}})
          .value_or(plan.paper);
  plan.format = read_format<PageFormat>({"--out", arguments.out_file, plan.errors},
                                        {{".pdf", PageFormat::pdf}, {".png", PageFormat::png}})
                    .value_or(plan.format);
  constexpr double kMinDpi = 100, kMaxDpi = 1200;
  plan.dpi =
      read_number_within({"--dpi", arguments.dpi, plan.errors}, kMinDpi, kMaxDpi, "--dpi 300")
          .value_or(plan.dpi);
  if (!arguments.dpi.empty() && plan.format == PageFormat::pdf && plan.errors.empty()) {
    plan.errors.push_back(
        fmt::format("--dpi {}: a PDF has no pixels. Fix: leave it out, or let --out end in .png.",
                    arguments.dpi));
  }
  check_output_places({{"--out", arguments.out_file, {}, "repose board"}}, {}, plan.errors);
  return plan;
}

}  // namespace

ExitCode run_board(const BoardArguments& arguments) {
  const BoardPlan plan = plan_board(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  if (plan.format == PageFormat::pdf) {
    base::write_whole_file(arguments.out_file, vision::board_pdf(plan.paper));
  } else {
    vision::write_picture(arguments.out_file, vision::board_picture(plan.paper, plan.dpi));
  }
  Outputs outputs;
  outputs.show(fmt::format(
      "{}: a board of {} x {} squares of {:g} mm. Print it at {}, and check its line of 100 mm.\n",
      arguments.out_file, vision::kBoardColumns, vision::kBoardRows, vision::kBoardSquare_mm,
      plan.format == PageFormat::pdf ? "100 % (actual size)"
                                     : fmt::format("{:g} pixels per inch", plan.dpi)));
  outputs.write();
  return ExitCode::done;
}

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
