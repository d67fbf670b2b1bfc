#include "cli/commands.h"

#include "cli/calibrate/calibrate_command.h"
#include "cli/compare/compare_command.h"
#include "cli/export/export_command.h"
#include "cli/measure/measure_command.h"
#include "cli/render/render_command.h"
#include "cli/report/report_command.h"
#include "cli/shape/shape_command.h"
#include "cli/simulate/simulate_command.h"
#include "cli/statistics/statistics_commands.h"
#include "cli/verify/verify_command.h"

namespace repose::cli {

std::vector<Command> all_commands() {
  return {measure_command(), compare_command(),   shape_command(),   simulate_command(),
          render_command(),  calibrate_command(), report_command(),  export_command(),
          bench_command(),   design_command(),    regress_command(), verify_command()};
}

}  // namespace repose::cli
