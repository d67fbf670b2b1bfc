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

  calibrate::SurfaceSummary summary = summary_of(plan.report);
  summary.left_out = plan.left_out;
  summary.notes = plan.notes;
  Outputs outputs;
  outputs.add(plan.json_file, to_json(summary));
  outputs.show(regress_table(plan, columns_of(stdout)));
  outputs.write();
  return ExitCode::done;
}

}  // namespace repose::cli
