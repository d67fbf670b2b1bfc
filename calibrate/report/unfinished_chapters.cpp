#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "calibrate/report/chapters.h"
#include "calibrate/report/wording.h"
#include "calibrate/study/study_budget.h"

namespace repose::calibrate::report {
namespace {

/// For a POSIX shell.
std::string quoted_word(const std::string& word) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=,:+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char letter : word)
    quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

std::string command_to_go_on(const ReportedStudy& study) {
  std::string command = "repose calibrate ";
  if (study.study) {
    command += quoted_word(study.study->file);
    if (study.study->method != "joint") command += " --method " + quoted_word(study.study->method);
    if (const auto minutes = minutes_in(study.study->budget)) {
      command += fmt::format(" --minutes {:g}", *minutes);
    } else if (study.study->budget != "quick") {
      command += " --budget " + quoted_word(study.study->budget);
    }
    if (study.study->is_mixed == false) command += " --fidelity full";
    for (const std::string& setting : study.study->settings) {
      command += " --set " + quoted_word(setting);
    }
  } else {
    command +=
        study.made && !study.made->study.empty() ? quoted_word(study.made->study) : "STUDY.toml";
  }
  return command + " --out " + quoted_word(study.folder.string());
}

Table counts_table(const ReportedStudy& study) {
  std::map<std::string, std::array<double, 2>> counts;
  for (const SavedRun& run : study.runs) {
    auto& [done, failed] = counts[run.experiment];
    ++done;
    if (!run.failure.empty()) ++failed;
  }
  Table table{
      .name = "simulations",
      .title = study.made ? "Runs made" : "Simulations completed",
      .data = {.columns = {{.name = study.made ? "reading" : "experiment", .unit = {}},
                           {.name = study.made ? "runs" : "simulations", .unit = {}, .decimals = 0},
                           {.name = "without a reading", .unit = {}, .decimals = 0}},
               .rows = {}}};
  for (const auto& [experiment, count] : counts) {
    table.data.add({shortened(experiment), count[0], count[1]});
  }
  return table;
}

/// If a folder does not state what was measured: the experiments themselves.
std::vector<MeasuredNumber> shown_numbers(const ReportedStudy& study) {
  if (!study.measured.empty()) return study.measured;
  std::vector<MeasuredNumber> numbers;
  for (const SavedRun& run : study.runs) {
    const bool is_known = std::any_of(numbers.begin(), numbers.end(), [&](const auto& number) {
      return number.name == run.experiment;
    });
    if (is_known) continue;
    numbers.push_back({.name = run.experiment,
                       .experiment = run.experiment,
                       .reading = "value",
                       .unit = unit_of_experiment(run.experiment),
                       .measured = {},
                       .uncertainty = {}});
  }
  return numbers;
}

std::string progress_text(const ReportedStudy& study) {
  constexpr const char* kRest =
      "there is no result yet. Nothing is lost: the same command resumes where it was interrupted.";
  if (!study.made) {
    return fmt::format("{} simulations are complete, but {}", study.runs.size(), kRest);
  }
  return fmt::format(
      "{} runs were made by another program, of which {} failed, and {} that were asked for are "
      "still to be made: {}",
      study.made->made, study.made->failed, study.made->to_make, kRest);
}

}  // namespace

std::vector<Chapter> unfinished_chapters(const ReportedStudy& study) {
  Chapter state{.id = "answer", .title = "Progress", .blocks = {}};
  state.blocks.push_back(Paragraph{progress_text(study)});
  if (study.has_other_result) {
    state.blocks.push_back(
        Remark{"The folder's result.json is from another study, budget or method, and is not shown "
               "here."});
  }
  if (!study.runs.empty()) state.blocks.push_back(counts_table(study));
  state.blocks.push_back(CodeText{.label = "To continue", .text = command_to_go_on(study)});

  Chapter runs{.id = "curves", .title = "Results of the runs", .blocks = {}};
  for (const MeasuredNumber& number : shown_numbers(study)) {
    std::vector<Chart> charts = run_charts(study, number);
    if (charts.empty()) continue;
    runs.blocks.push_back(Heading{titled(axis_of_observable(number.name, ""))});
    runs.blocks.push_back(ChartRow{std::move(charts)});
  }
  return {std::move(state), std::move(runs)};
}

}  // namespace repose::calibrate::report
