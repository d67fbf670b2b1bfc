#include "cli/statistics/regress.h"

#include "cli/output.h"
#include "cli/statistics/regress_json.h"
#include "cli/statistics/regress_options.h"
#include "cli/statistics/regress_table.h"
#include "cli/terminal.h"

namespace repose::cli {

ExitCode run_regress(const RegressArguments& arguments) {
  const RegressPlan plan = plan_regress(arguments);
  print_lines(plan.faults);
  if (!plan.faults.empty()) return ExitCode::bad_input;

  if (plan.json_file != kStandardOutput) {
    write_output(std::string(kStandardOutput), regress_table(plan.report, columns_of(stdout)));
  }
  if (!plan.json_file.empty()) write_output(plan.json_file, regress_json(plan.report));
  return ExitCode::done;
}

}  // namespace repose::cli
