#include "cli/statistics/regress.h"

#include "calibrate/result/surface_summary.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"
#include "cli/statistics/regress_options.h"
#include "cli/statistics/regress_table.h"

namespace repose::cli {

ExitCode run_regress(const RegressArguments& arguments) {
  const RegressPlan plan = plan_regress(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;

  Outputs outputs;
  outputs.add(plan.json_file, to_json(summary_of(plan.report)));
  outputs.show(regress_table(plan.report, columns_of(stdout)));
  outputs.write();
  return ExitCode::done;
}

}  // namespace repose::cli
