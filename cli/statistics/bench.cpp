#include "cli/statistics/bench.h"

#include "cli/common/output.h"
#include "cli/common/terminal.h"
#include "cli/statistics/bench_options.h"
#include "cli/statistics/bench_report.h"

namespace repose::cli {

ExitCode run_bench(const BenchArguments& arguments) {
  const BenchPlan plan = plan_bench(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;

  Outputs outputs;
  outputs.add(plan.json_file, bench_json(arguments.test, plan.result));
  outputs.show(bench_table(arguments.test, plan.result, columns_of(stdout)));
  outputs.write();
  return ExitCode::done;
}

}  // namespace repose::cli
