#include "cli/verify/verify.h"

#include <algorithm>
#include <memory>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/common/output.h"
#include "cli/common/table.h"
#include "cli/common/terminal.h"
#include "dem/verify/verify.h"

namespace repose::cli {

namespace {

/// A case's name and source, then a row for each of its numbers.
std::string verify_table(const std::vector<dem::CaseResult>& results, int columns) {
  Table table({{.heading = "case, quantity"},
               number_column("expected"),
               number_column("measured"),
               number_column("error"),
               number_column("allowed"),
               number_column("step [s]"),
               {.heading = ""}});
  std::string_view name;
  for (const dem::CaseResult& result : results) {
    if (result.name != name) {
      name = result.name;
      table.add_note("", fmt::format("{} [{}]", result.name, result.source));
    }
    table.add_row({fmt::format("  {}", result.quantity), fmt::format("{:.5g}", result.expected),
                   fmt::format("{:.5g}", result.measured),
                   fmt::format("{:.2g}", result.measured - result.expected),
                   fmt::format("{:.2g}", result.tolerance),
                   fmt::format("{:.2g}", result.timestep_s), result.holds ? "pass" : "FAIL"});
  }
  const auto passed = std::count_if(results.begin(), results.end(),
                                    [](const dem::CaseResult& result) { return result.holds; });
  return table.text(columns) +
         fmt::format("{} of {} numbers are within tolerance\n", passed, results.size());
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
  constexpr int kNoteIndent = 2;
  return json.dump(kNoteIndent) + '\n';
}

}  // namespace

ExitCode run_verify(const VerifyArguments& arguments) {
  std::vector<std::string> errors;
  check_output_places({json_place(arguments.json_file, "\"timestep_s\"")}, {}, errors);
  print_lines(errors);
  if (!errors.empty()) return ExitCode::bad_input;
  std::vector<dem::CaseResult> results;
  {
    Progress progress(dem::case_names().size(), "verified");
    results = dem::run_cases(
        [&progress](std::size_t /*done*/, std::size_t /*count*/) { progress.advance(); });
  }
  Outputs outputs;
  outputs.add(arguments.json_file, verify_json(results));
  outputs.show(verify_table(results, columns_of(stdout)));
  outputs.write();
  const bool all_hold = std::all_of(results.begin(), results.end(),
                                    [](const dem::CaseResult& result) { return result.holds; });
  return all_hold ? ExitCode::done : ExitCode::internal_error;
}

Command verify_command() {
  const auto given = std::make_shared<VerifyArguments>();
  return {.name = "verify",
          .summary = "Check the physics against known solutions",
          .options = {{"--json", "FILE|-", "Full results, for programs", &given->json_file}},
          .run = [given] { return run_verify(*given); }};
}

}  // namespace repose::cli
