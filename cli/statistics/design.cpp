#include "cli/statistics/design.h"

#include "cli/common/output.h"
#include "cli/statistics/design_csv.h"
#include "cli/statistics/design_options.h"

namespace repose::cli {

ExitCode run_design(const DesignArguments& arguments) {
  const DesignPlan plan = plan_design(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  print_lines(plan.notes);
  Outputs outputs;
  outputs.add(plan.out_file, design_csv(plan.design, plan.csv));
  outputs.write();
  return ExitCode::done;
}

}  // namespace repose::cli
