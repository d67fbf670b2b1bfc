#include "cli/commands.h"

#include "cli/board/board_command.h"
#include "cli/calibrate/calibrate_command.h"
#include "cli/camera/camera_command.h"
#include "cli/compare/compare_command.h"
#include "cli/export/export_command.h"
#include "cli/help/help_commands.h"
#include "cli/measure/measure_command.h"
#include "cli/new/new_command.h"
#include "cli/plan/plan_command.h"
#include "cli/render/render_command.h"
#include "cli/report/report_command.h"
#include "cli/shape/shape_command.h"
#include "cli/simulate/simulate_command.h"
#include "cli/statistics/statistics_commands.h"
#include "cli/track/track_command.h"
#include "cli/verify/verify_command.h"

namespace repose::cli {

std::vector<Command> all_commands() {
  std::vector<Command> commands = {measure_command(),  board_command(),     camera_command(),
                                   compare_command(),  track_command(),     shape_command(),
                                   simulate_command(), render_command(),    new_command(),
                                   plan_command(),     calibrate_command(), report_command(),
                                   export_command(),   bench_command(),     design_command(),
                                   regress_command(),  verify_command()};
  const std::vector<Command> of_help = help_commands(commands);
  commands.insert(commands.end(), of_help.begin(), of_help.end());
  return commands;
}

}  // namespace repose::cli
