#include "cli/calibrate/calibrate_engine.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "calibrate/engine/engine_study.h"
#include "calibrate/run/run_study.h"
#include "calibrate/runs/table_study.h"
#include "cli/calibrate/calibrate_runs.h"
#include "cli/common/option_value.h"
#include "cli/common/table.h"
#include "cli/common/terminal.h"

namespace repose::cli {
namespace {

/// Progress of the runs. On a terminal one line that is overwritten, otherwise a line for each
/// round.
class RunsProgress {
 public:
  void report(const calibrate::EngineProgress& progress) {
    if (!before_) before_ = progress.made;
    const std::string text = fmt::format("{} of at most {} runs made, {} failed", progress.made,
                                         progress.most, progress.failed);
    if (progress.asked != asked_) {
      asked_ = progress.asked;
      if (!is_terminal(stderr)) {
        print_line(fmt::format("{}; making {} more", text, progress.asked - progress.made));
      }
    }
    if (!line_) line_ = std::make_unique<ProgressLine>("at most {} left");
    const auto done = static_cast<double>(progress.made - *before_);
    const auto all = static_cast<double>(std::max(progress.most, progress.made + 1) - *before_);
    line_->show_next();
    line_->report(text, done / all);
  }

  /// The next message starts on a new line, and the remaining time is estimated from here on.
  void hide() {
    line_.reset();
    before_.reset();
  }

 private:
  std::unique_ptr<ProgressLine> line_;
  std::optional<std::size_t> before_;  ///< runs made when the line began
  std::size_t asked_ = 0;
};

/// Reads the options into a request.
calibrate::EngineRequest request_of(const CalibrateArguments& arguments,
                                    std::vector<std::string>& errors) {
  constexpr int kMostRuns = 1000;
  calibrate::EngineRequest request{.study = arguments.study,
                                   .settings = arguments.settings,
                                   .runs = {arguments.runs.begin(), arguments.runs.end()},
                                   .folder = arguments.out_folder};
  if (request.folder.empty()) request.folder = calibrate::default_folder(request.study);
  if (!arguments.jobs.empty()) {
    request.jobs = read_whole_number({"--jobs", arguments.jobs, errors}, 1, kMaxThreads, "--jobs 2")
                       .value_or(1);
  }
  if (!arguments.max_runs.empty()) {
    request.max_runs = read_whole_number({"--max-runs", arguments.max_runs, errors}, 0, kMostRuns,
                                         "--max-runs 40");
  }
  return request;
}

std::string run_time_text(double seconds) {
  constexpr double kFew_s = 10;
  return seconds < kFew_s ? fmt::format("{:.2g} s", seconds) : time_text(seconds);
}

std::string forecast_text(const calibrate::EngineForecast& forecast, int jobs, int columns) {
  Page page(columns);
  page.add(fmt::format("Runs made: {}, of which {} failed; at most {} will be made.", forecast.made,
                       forecast.failed, forecast.most));
  if (forecast.next > 0) page.add(fmt::format("To be made next: {}.", forecast.next));
  if (!forecast.settled.empty()) page.add(forecast.settled.front());
  const std::size_t left = forecast.most > forecast.made ? forecast.most - forecast.made : 0;
  if (!forecast.run_s) {
    page.add("How long a run takes, nothing tells yet: the first runs will.");
  } else if (forecast.next > 0) {
    page.add(fmt::format(
        "A run took {} on average: {} for the next ones, at most {} for all, with --jobs {}.",
        run_time_text(*forecast.run_s),
        run_time_text(*forecast.run_s * std::ceil(static_cast<double>(forecast.next) / jobs)),
        run_time_text(*forecast.run_s * std::ceil(static_cast<double>(left) / jobs)), jobs));
  }
  page.add("Nothing was made or saved.");
  return page.text();
}

}  // namespace

bool has_engine(const CalibrateArguments& arguments) {
  if (!calibrate::is_table_study(arguments.study)) return false;
  return calibrate::read_table_study(arguments.study, arguments.settings).engine.has_value();
}

ExitCode run_calibrate_engine(const CalibrateArguments& arguments) {
  std::vector<std::string> errors;
  refuse_simulations(arguments, "[engine]", errors);
  const calibrate::EngineRequest request = request_of(arguments, errors);
  if (arguments.is_dry_run && !arguments.json_file.empty()) {
    errors.emplace_back("--dry-run: gives no results for --json. Fix: leave one of them out.");
  }
  check_json_place(arguments, request.folder, errors);
  print_lines(errors);
  if (!errors.empty()) return ExitCode::bad_input;
  if (arguments.is_dry_run) {
    Outputs outputs;
    outputs.show(forecast_text(forecast_of(request), request.jobs, columns_of(stdout)));
    outputs.write();
    return ExitCode::done;
  }
  RunsProgress progress;
  const auto result = calibrate::calibrate_with_engine(
      request, {.report = [&](const calibrate::EngineProgress& made) { progress.report(made); },
                .note =
                    [&](const std::string& text) {
                      progress.hide();
                      print_line(text);
                    },
                .is_interrupted = &watch_for_interrupt()});
  progress.hide();
  if (!result) {
    print_line(fmt::format(
        "interrupted; no result was written. The same command goes on from here: the runs are in "
        "{}.",
        (request.folder / "runs").string()));
    return ExitCode::interrupted;
  }
  show_fit(arguments, *result);
  return ExitCode::done;
}

}  // namespace repose::cli
