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
  const std::string test(calibrate::kBenchTestNames.at(static_cast<std::size_t>(plan.test)));
  outputs.add(plan.json_file, bench_json(test, plan.result));
  outputs.show(bench_table(test, plan.result, columns_of(stdout)));
  outputs.write();
  return ExitCode::done;
}

}  // namespace repose::cli
