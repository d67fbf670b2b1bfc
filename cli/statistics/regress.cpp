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

  if (plan.json_file != kStandardOutput) {
    write_output(std::string(kStandardOutput), regress_table(plan.report, columns_of(stdout)));
  }
  if (!plan.json_file.empty()) write_output(plan.json_file, to_json(summary_of(plan.report)));
  return ExitCode::done;
}

}  // namespace repose::cli
