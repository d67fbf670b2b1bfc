#include "cli/verify/verify.h"

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "calibrate/simulators/case_peers.h"
#include "cli/common/output.h"
#include "cli/common/table.h"
#include "cli/common/terminal.h"
#include "dem/verify/case_peer.h"
#include "dem/verify/verify.h"

namespace repose::cli {

namespace {

using Results = std::vector<dem::CaseResult>;

/// Another program's results of the cases, looked up by case and number.
class PeerResults {
 public:
  PeerResults() = default;
  PeerResults(std::string title, std::vector<dem::PeerCase> cases)
      : title_(std::move(title)), cases_(std::move(cases)) {}

  bool is_there() const { return !title_.empty(); }
  const std::string& title() const { return title_; }
  const std::vector<dem::PeerCase>& cases() const { return cases_; }

  /// The corresponding result of theirs, or null.
  const dem::CaseResult* of(const dem::CaseResult& ours) const {
    for (const dem::PeerCase& each : cases_) {
      if (each.name != ours.name) continue;
      for (const dem::CaseResult& result : each.results) {
        if (result.quantity == ours.quantity && result.timestep_s == ours.timestep_s) {
          return &result;
        }
      }
    }
    return nullptr;
  }

  const dem::PeerCase& case_of(const std::string& name) const {
    return *std::ranges::find(cases_, name, &dem::PeerCase::name);
  }

 private:
  std::string title_;
  std::vector<dem::PeerCase> cases_;
};

std::ptrdiff_t count_holding(const Results& results) {
  return std::ranges::count_if(results, &dem::CaseResult::holds);
}

std::string number_of(double value) { return fmt::format("{:.5g}", value); }

/// A case's name and source, then a row for each of its numbers.
std::string verify_table(const Results& results, int columns) {
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
    table.add_row({fmt::format("  {}", result.quantity), number_of(result.expected),
                   number_of(result.measured),
                   fmt::format("{:.2g}", result.measured - result.expected),
                   fmt::format("{:.2g}", result.tolerance),
                   fmt::format("{:.2g}", result.timestep_s), result.holds ? "pass" : "FAIL"});
  }
  return table.text(columns) + fmt::format("{} of {} numbers are within tolerance\n",
                                           count_holding(results), results.size());
}

/// The same for two programs. The other one's numbers are not judged, as its laws may differ.
std::string comparison_table(const Results& results, const PeerResults& peer, int columns) {
  Table table({{.heading = "case, quantity"},
               number_column("expected"),
               number_column("allowed"),
               number_column("repose"),
               {.heading = ""},
               number_column("other"),
               {.heading = ""},
               number_column("step [s]")});
  std::string_view name;
  std::size_t compared = 0, near = 0;
  for (const dem::CaseResult& result : results) {
    const dem::CaseResult* theirs = peer.of(result);
    if (result.name != name) {
      name = result.name;
      table.add_note("", fmt::format("{} [{}]", result.name, result.source));
    }
    compared += theirs != nullptr ? 1 : 0;
    near += theirs != nullptr && theirs->holds ? 1 : 0;
    table.add_row({fmt::format("  {}", result.quantity), number_of(result.expected),
                   fmt::format("{:.2g}", result.tolerance), number_of(result.measured),
                   result.holds ? "pass" : "FAIL", theirs ? number_of(theirs->measured) : "-",
                   theirs && !theirs->holds ? "differs" : "",
                   fmt::format("{:.2g}", result.timestep_s)});
  }
  std::string text = table.text(columns);
  text += fmt::format("repose: {} of {} numbers are within tolerance\n", count_holding(results),
                      results.size());
  text += fmt::format("other: {}; {} of its {} numbers are within the tolerances of repose\n",
                      peer.title(), near, compared);
  for (const dem::PeerCase& each : peer.cases()) {
    for (const std::string& change : each.changes) {
      text += paragraph("run there otherwise: ", fmt::format("{}: {}", each.name, change), columns);
    }
  }
  for (const dem::PeerCase& each : peer.cases()) {
    if (each.cannot.empty()) continue;
    text += paragraph("not run there: ", fmt::format("{}: {}", each.name, each.cannot), columns);
  }
  return text;
}

nlohmann::ordered_json peer_json(const dem::CaseResult& ours, const PeerResults& peer) {
  nlohmann::ordered_json json = {{"program", peer.title()}};
  if (const dem::CaseResult* theirs = peer.of(ours)) {
    json["measured"] = theirs->measured;
    json["error"] = theirs->measured - theirs->expected;
    json["holds"] = theirs->holds;
    json["changes"] = peer.case_of(ours.name).changes;
  } else {
    json["cannot"] = peer.case_of(ours.name).cannot;
  }
  return json;
}

std::string verify_json(const Results& results, const PeerResults& peer) {
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
    if (peer.is_there()) json.back()["other"] = peer_json(result, peer);
  }
  constexpr int kNoteIndent = 2;
  return json.dump(kNoteIndent) + '\n';
}

/// Runs the cases there, showing progress.
PeerResults results_in(const std::string& program) {
  const auto peer = calibrate::case_peer_of(program);
  Progress progress(dem::case_names().size(), "run by the other program");
  return {peer->title(),
          dem::run_cases_in(*peer, [&progress](std::size_t, std::size_t) { progress.advance(); })};
}

}  // namespace

ExitCode run_verify(const VerifyArguments& arguments) {
  std::vector<std::string> errors;
  check_output_places({json_place(arguments.json_file, "\"timestep_s\"")}, {}, errors);
  print_lines(errors);
  if (!errors.empty()) return ExitCode::bad_input;
  const PeerResults peer = arguments.engine.empty() ? PeerResults{} : results_in(arguments.engine);
  Results results;
  {
    Progress progress(dem::case_names().size(), "verified");
    results = dem::run_cases(
        [&progress](std::size_t /*done*/, std::size_t /*count*/) { progress.advance(); });
  }
  Outputs outputs;
  outputs.add(arguments.json_file, verify_json(results, peer));
  const int columns = columns_of(stdout);
  outputs.show(peer.is_there() ? comparison_table(results, peer, columns)
                               : verify_table(results, columns));
  outputs.write();
  return std::ranges::all_of(results, &dem::CaseResult::holds) ? ExitCode::done
                                                               : ExitCode::internal_error;
}

Command verify_command() {
  const auto given = std::make_shared<VerifyArguments>();
  return {.name = "verify",
          .summary = "Check the physics against known solutions",
          .options = {{"--engine", "liggghts", "Run them in this program, too, and list both",
                       &given->engine},
                      {"--json", "FILE|-", "Full results, for programs", &given->json_file}},
          .run = [given] { return run_verify(*given); }};
}

}  // namespace repose::cli
