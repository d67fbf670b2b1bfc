#include "cli/verify/verify.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "dem/verify/verify.h"

namespace repose::cli {
namespace {

/// A case's name and source, then a row for each of its numbers: 99 columns.
std::string verify_table(const std::vector<dem::CaseResult>& results) {
  std::string text = fmt::format("{:<45} {:>9} {:>10} {:>9} {:>8} {:>8}\n", "case, quantity",
                                 "expected", "measured", "error", "allowed", "step, s");
  std::string_view name;
  for (const dem::CaseResult& result : results) {
    if (result.name != name) {
      name = result.name;
      text += fmt::format("{} [{}]\n", result.name, result.source);
    }
    text +=
        fmt::format("  {:<43} {:>9.5g} {:>10.5g} {:>9.2g} {:>8.2g} {:>8.2g} {}\n", result.quantity,
                    result.expected, result.measured, result.measured - result.expected,
                    result.tolerance, result.timestep_s, result.holds ? "pass" : "FAIL");
  }
  const auto passed = std::count_if(results.begin(), results.end(),
                                    [](const dem::CaseResult& result) { return result.holds; });
  return text + fmt::format("{} of {} numbers are within tolerance\n", passed, results.size());
}

std::string verify_json(const std::vector<dem::CaseResult>& results) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const dem::CaseResult& result : results) {
    json.push_back({{"case", result.name},
                    {"quantity", result.quantity},
                    {"source", result.source},
                    {"expected", result.expected},
                    {"measured", result.measured},
                    {"error", result.measured - result.expected},
                    {"tolerance", result.tolerance},
                    {"timestep_s", result.timestep_s},
                    {"holds", result.holds}});
  }
  constexpr int kIndent = 2;
  return json.dump(kIndent) + '\n';
}

}  // namespace

ExitCode run_verify(const VerifyArguments& arguments) {
  std::vector<dem::CaseResult> results;
  {
    Progress progress(dem::case_names().size());
    results = dem::run_cases(
        [&progress](std::size_t /*done*/, std::size_t /*count*/) { progress.advance(); });
  }
  if (arguments.json_file != kStandardOutput) {
    write_output(std::string(kStandardOutput), verify_table(results));
  }
  if (!arguments.json_file.empty()) write_output(arguments.json_file, verify_json(results));
  const bool all_hold = std::all_of(results.begin(), results.end(),
                                    [](const dem::CaseResult& result) { return result.holds; });
  return all_hold ? ExitCode::done : ExitCode::internal_error;
}

}  // namespace repose::cli
