#include "cli/calibrate/rolling_models.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "calibrate/result/candidates.h"
#include "calibrate/run/run_study.h"
#include "calibrate/study/executor.h"
#include "calibrate/study/study_record.h"
#include "cli/calibrate/calibrate_options.h"
#include "cli/calibrate/calibrate_table.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/table.h"
#include "cli/common/terminal.h"
#include "dem/contact/model_names.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKey = "contact.rolling_model";

/// Those with a coefficient: the others have one less to fit and could not be compared with them.
std::vector<std::string> known_models() {
  std::vector<std::string> names;
  for (const auto& [model, name] : dem::kRollingNames) {
    if (model != dem::RollingModel::none) names.emplace_back(name);
  }
  return names;
}

std::vector<std::string> models_in(const CalibrateArguments& arguments,
                                   std::vector<std::string>& errors) {
  const std::vector<std::string> known = known_models();
  std::vector<std::string> models;
  const OptionText typed{"--rolling-models", arguments.rolling_models, errors};
  for (const std::size_t place : read_words(typed, known)) models.push_back(known[place]);
  if (models.size() == 1) {
    errors.push_back(fmt::format(
        "--rolling-models {}: must be two or more, to be compared. Fix: for one alone, --set '{}="
        "\"{}\"'.",
        arguments.rolling_models, kKey, models.front()));
  }
  return models;
}

/// Reports all options that make no sense with several models.
void check(const CalibrateArguments& arguments, std::vector<std::string>& errors) {
  if (arguments.method != "joint") {
    errors.push_back(fmt::format(
        "--rolling-models: compares fits with intervals, which --method {} does not make. Fix: "
        "leave one of them out.",
        arguments.method));
  }
  if (arguments.is_dry_run) {
    errors.emplace_back(
        "--rolling-models: takes as long as each model alone, added up. Fix: leave it out of "
        "--dry-run.");
  }
  if (!arguments.minutes.empty()) {
    errors.emplace_back(
        "--rolling-models: is several calibrations, and --minutes is of one. Fix: --budget.");
  }
  if (!arguments.progress_file.empty()) {
    errors.emplace_back(
        "--rolling-models: is several calibrations, and --progress is of one. Fix: leave one of "
        "them out.");
  }
  if (!arguments.json_file.empty()) {
    errors.emplace_back(
        "--rolling-models: each model has a result of its own. Fix: leave out --json, and read "
        "result.json in each model's folder.");
  }
  if (std::ranges::any_of(arguments.settings, [](const std::string& setting) {
        return setting.starts_with(std::string(kKey) + '=');
      })) {
    errors.push_back(
        fmt::format("--set {}: contradicts --rolling-models. Fix: leave one of them out.", kKey));
  }
  if (calibrate::is_launched_as_rank()) {
    errors.push_back(fmt::format(
        "--rolling-models: not under mpirun. Fix: start a job for each model, with --set '{}="
        "\"constant_torque\"' and an --out of its own.",
        kKey));
  }
}

std::string score_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.1f}", value) : kMissing;
}

std::string page_of(const std::vector<calibrate::Candidate>& candidates, const fs::path& folder) {
  Page page(std::min(columns_of(stdout), kWidestText));
  Table table({{.heading = "rolling model"},
               number_column("score: means"),
               number_column("scatter"),
               number_column("sum"),
               {.heading = "verdict"}});
  for (const calibrate::Candidate& candidate : candidates) {
    table.add_row({candidate.name, score_text(candidate.means), score_text(candidate.scatter),
                   score_text(candidate_score(candidate)), name_of(candidate.verdict)});
  }
  page.add_gap();
  page.add(table);
  page.add(
      "(the lower the better; made of what the means of all experiments lack together, as a "
      "chi-square, and of how much more single readings scatter than the bench's, as a likelihood "
      "ratio)");
  page.add_gap();
  page.add(fmt::format("Of these rolling models, {}.", candidates_text(candidates)));
  page.add(fmt::format("Each has a folder of its own in {}.", folder.string()));
  return page.text();
}

/// Saves in each result what it was compared with.
void keep(const std::vector<fs::path>& folders, std::vector<calibrate::StudyResult>& results,
          const std::vector<calibrate::Candidate>& candidates) {
  Outputs outputs;
  for (std::size_t k = 0; k < results.size(); ++k) {
    std::get<calibrate::JointResult>(results[k].found).candidates = candidates;
    outputs.add((folders[k] / calibrate::kResultFile).string(), to_json(results[k]));
  }
  outputs.show(page_of(candidates, folders.front().parent_path()));
  outputs.write();
}

}  // namespace

ExitCode run_rolling_models(const CalibrateArguments& arguments) {
  std::vector<std::string> errors;
  const std::vector<std::string> models = models_in(arguments, errors);
  check(arguments, errors);
  print_lines(errors);
  if (!errors.empty()) return ExitCode::bad_input;
  fs::path folder = arguments.out_folder;
  if (folder.empty()) folder = calibrate::default_folder(arguments.study);
  std::vector<fs::path> folders;
  std::vector<calibrate::StudyResult> results;
  std::vector<calibrate::Candidate> candidates;
  for (const std::string& model : models) {
    CalibrateArguments with = arguments;
    with.rolling_models.clear();
    with.settings.push_back(fmt::format("{}=\"{}\"", kKey, model));
    folders.push_back(folder / model);
    with.out_folder = folders.back().string();
    print_line(fmt::format("rolling model {}, in {}", model, with.out_folder));
    const ExitCode code = run_calibrate(with);
    if (code != ExitCode::done) return code;
    results.push_back(calibrate::read_result(folders.back()).value());
    candidates.push_back(
        calibrate::candidate_of(model, std::get<calibrate::JointResult>(results.back().found)));
  }
  keep(folders, results, candidates);
  return ExitCode::done;
}

}  // namespace repose::cli
