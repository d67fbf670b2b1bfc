#include "cli/statistics/bench.h"

#include "cli/output.h"
#include "cli/statistics/bench_options.h"
#include "cli/statistics/bench_report.h"
#include "cli/terminal.h"

namespace repose::cli {

ExitCode run_bench(const BenchArguments& arguments) {
  const BenchPlan plan = plan_bench(arguments);
  print_lines(plan.faults);
  if (!plan.faults.empty()) return ExitCode::bad_input;

  if (plan.json_file != kStandardOutput) {
    write_output(std::string(kStandardOutput),
                 bench_table(arguments.test, plan.result, columns_of(stdout)));
  }
  if (!plan.json_file.empty())
    write_output(plan.json_file, bench_json(arguments.test, plan.result));
  return ExitCode::done;
}

}  // namespace repose::cli
