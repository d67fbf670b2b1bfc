#include "cli/board/board.h"

#include <vector>

#include <fmt/format.h>

#include "base/whole_file.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/output_places.h"
#include "vision/camera/board_page.h"

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
  constexpr double kLeastDpi = 100, kMostDpi = 1200;
  plan.dpi =
      read_number_within({"--dpi", arguments.dpi, plan.errors}, kLeastDpi, kMostDpi, "--dpi 300")
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

}  // namespace repose::cli
