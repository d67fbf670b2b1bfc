#include "calibrate/engine/engine_study.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/folder_lock.h"
#include "base/input_error.h"
#include "calibrate/engine/engine.h"
#include "calibrate/engine/engine_runs.h"
#include "calibrate/engine/make_runs.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/fit/fit_watch.h"
#include "calibrate/run/run_study.h"
#include "calibrate/runs/next_runs.h"
#include "calibrate/runs/table_fit.h"
#include "calibrate/runs/table_runs.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

/// Runs of a round are planned together: many keep many jobs busy, few are chosen better.
constexpr std::size_t kRound = 8;
/// Name of the run table, independent of the folder, so that results are the same in any.
constexpr const char* kRunsInFolder = "runs/runs.csv";
/// If none of this many first runs gives a reading, none will.
constexpr std::size_t kFirst = 3;
/// For a stochastic program, at the fitted parameters: as many as repose makes of its own expensive
/// runs.
constexpr int kUsualCheckRuns = 6;
constexpr const char* kByFailures = "failures";

/// Enough points for a fit, although one in six is a repeat and some may fail.
std::size_t start_runs(std::size_t parameters) { return 3 * parameters + 3; }

TableStudy study_with_engine(const EngineRequest& request) {
  TableStudy study = read_table_study(request.study, request.settings);
  if (study.engine) return study;
  base::refuse(request.study, "has no [engine]: nothing says how runs are made",
               "[engine] with command = \"python3 run.py\"; or make the runs, and give them with "
               "--runs runs.csv.");
}

/// The study, its existing runs, and what to make next.
class EngineStudy {
 public:
  explicit EngineStudy(const EngineRequest& request)
      : request_(request),
        study_(study_with_engine(request)),
        folder_(request.folder.empty() ? default_folder(request.study) : request.folder),
        runs_(study_, folder_) {
    const std::size_t parameters = study_.parameters.size();
    most_ = static_cast<std::size_t>(
        request.max_runs.value_or(study_.engine->max_runs.value_or(usual_max_runs(parameters))));
    base::Faults faults;
    if (auto fault = fault_of_folder(folder_, request.study)) faults.add(std::move(*fault));
    const std::size_t start = start_runs(parameters);
    faults.require(
        most_ >= start || request.max_runs == 0 || !request.runs.empty() || runs_.made() > 0,
        {.subject = "max_runs",
         .value = fmt::format("{}", most_),
         .rule =
             fmt::format("{} or more, of which a fit of {} parameters begins", start, parameters),
         .fix = "more runs; or fewer parameters."});
    faults.throw_if_any();
    runs_.retry_if_none_succeeded();
  }

  const TableStudy& study() const { return study_; }
  const fs::path& folder() const { return folder_; }
  EngineRuns& runs() { return runs_; }
  std::size_t most() const { return most_; }

  /// All tables.
  std::vector<fs::path> tables() const {
    std::vector<fs::path> files = request_.runs;
    if (runs_.exists()) files.push_back(runs_.file());
    return files;
  }

  /// Planned runs that are still to be made, or newly planned ones; within the limit.
  NextRuns ask() {
    const std::size_t made = runs_.made();
    const std::size_t left = most_ > made ? most_ - made : 0;
    const TableRuns table = read_table_runs(study_, tables(), NoRows::allowed);
    NextRuns next;
    for (const std::size_t row : runs_.to_make()) {
      if (next.runs.size() < left) next.runs.push_back({runs_.run(row).values, {}});
    }
    if (!next.runs.empty() || left == 0) return next;
    const std::size_t round = table.places.empty() ? start_runs(study_.parameters.size()) : kRound;
    next = next_runs(study_, table, std::min(round, left));
    asked_ = table;
    return next;
  }

  /// Where runs are likely to fail, judged by all made so far: NextRuns::left_out.
  std::string left_out() {
    if (runs_.failed() == 0) return {};
    return next_runs(study_, read_table_runs(study_, tables(), NoRows::allowed), kRound).left_out;
  }

  /// Rows for the runs that ask() has returned.
  std::vector<std::size_t> rows_for(const NextRuns& next) {
    if (asked_) runs_.plan(*std::exchange(asked_, std::nullopt), next.runs);
    std::vector<std::size_t> rows = runs_.to_make();
    rows.resize(std::min(rows.size(), next.runs.size()));
    return rows;
  }

 private:
  const EngineRequest& request_;
  TableStudy study_;
  fs::path folder_;
  EngineRuns runs_;
  std::size_t most_ = 0;
  std::optional<TableRuns> asked_;  ///< on which the last planned runs were based
};

/// Notes runs made by another command, script or settings.
void note_other_engines(EngineStudy& of, const Engine& engine, std::vector<std::string>& notes) {
  std::vector<std::string> others;
  std::error_code error;
  std::vector<fs::path> folders;
  for (fs::directory_iterator entry(of.runs().folder(), error), end; !error && entry != end;
       entry.increment(error)) {
    if (!entry->path().filename().string().starts_with("check_")) folders.push_back(entry->path());
  }
  std::ranges::sort(folders);
  for (const fs::path& folder : folders) {
    const std::string identity = engine.identity_in(folder);
    if (!identity.empty() && identity != engine.identity()) {
      others.push_back(folder.filename().string());
    }
  }
  if (others.empty()) return;
  notes.push_back(fmt::format(
      "The command, a file that it names, or the settings have changed since {} of the runs were "
      "made (the first: {}); they count as runs of the same model. If they are not, choose another "
      "folder with --out, or delete their rows in {}.",
      others.size(), others.front(), kRunsInFolder));
}

/// Makes runs until there are enough.
class Rounds {
 public:
  Rounds(EngineStudy& of, const Engine& engine, const EngineRequest& request,
         const EngineWatch& watch)
      : of_(of), engine_(engine), watch_(watch) {
    settings_ = {.jobs = request.jobs,
                 .timeout_s = of.study().engine->timeout_s,
                 .is_interrupted = watch.is_interrupted,
                 .report = [this] { report(); },
                 .note =
                     [this](const std::string& text) {
                       last_failure_ = text;
                       if (watch_.note) watch_.note(text);
                     }};
  }

  /// @return  whether it finished
  bool make_all() {
    while (true) {
      const NextRuns next = of_.ask();
      if (next.runs.empty()) {
        end_with(next);
        return true;
      }
      const std::vector<std::size_t> rows = of_.rows_for(next);
      asked_ = of_.runs().made() + rows.size();
      report();
      const auto failed = make(rows);
      if (!failed) return false;
      if (*failed == rows.size()) {
        end_with_failures(rows.size());
        return true;
      }
    }
  }

  EngineFacts facts() const {
    EngineFacts facts = facts_;
    facts.command = of_.study().engine->command;
    facts.runs = static_cast<int>(of_.runs().made());
    facts.failed = static_cast<int>(of_.runs().failed());
    return facts;
  }
  const std::vector<std::string>& notes() const { return notes_; }
  const MakeSettings& settings() const { return settings_; }

 private:
  void report() const {
    if (!watch_.report) return;
    watch_.report({.made = of_.runs().made(),
                   .failed = of_.runs().failed(),
                   .asked = asked_,
                   .most = of_.most()});
  }

  /// Makes only a few first, until one has given a reading.
  std::optional<std::size_t> make(const std::vector<std::size_t>& rows) {
    std::size_t failed = 0, begun = 0;
    if (!of_.runs().has_reading()) {
      begun = std::min(kFirst, rows.size());
      const std::vector<std::size_t> first(rows.begin(),
                                           rows.begin() + static_cast<std::ptrdiff_t>(begun));
      const auto of_first = make_runs(of_.runs(), engine_, first, settings_);
      if (!of_first) return std::nullopt;
      failed = *of_first;
      if (failed == begun) refuse_engine(begun);
    }
    const std::vector<std::size_t> others(rows.begin() + static_cast<std::ptrdiff_t>(begun),
                                          rows.end());
    const auto of_others = make_runs(of_.runs(), engine_, others, settings_);
    if (!of_others) return std::nullopt;
    return failed + *of_others;
  }

  [[noreturn]] void refuse_engine(std::size_t runs) const {
    throw base::InputError(
        {.where = of_.study().file.string(),
         .subject = "engine.command",
         .value = runs == 1 ? fmt::format("gave no reading in its first run: {}", last_failure_)
                            : fmt::format("gave no reading in its first {} runs; the last of "
                                          "them: {}",
                                          runs, last_failure_),
         .fix = fmt::format("see the folders in {}; then give the same command again.",
                            of_.runs().folder().string())});
  }

  void end_with_failures(std::size_t runs) {
    facts_.ended_by = kByFailures;
    notes_.push_back(fmt::format(
        "No more runs were made: {} failed. The folders beside {} tell why; empty the status of "
        "those that are to be made again.",
        runs == 1 ? "the last one" : fmt::format("all {} of the last ones", runs), kRunsInFolder));
  }

  void end_with(const NextRuns& next) {
    const bool is_settled = of_.runs().made() < of_.most();
    facts_.ended_by = is_settled ? "settled" : "max_runs";
    if (is_settled && !next.settled.empty()) {
      // The fit advises what would narrow the answer instead.
      notes_.push_back(next.settled.front());
    } else if (!is_settled && of_.most() > 0) {
      notes_.push_back(all_made_text());
    }
    if (std::string left_out = of_.left_out(); !left_out.empty()) notes_.push_back(left_out);
  }

  std::string all_made_text() const {
    const std::size_t failed = of_.runs().failed();
    std::string text = fmt::format(
        "All {} runs that may be made were made; more might narrow the answer. Fix: --max-runs.",
        of_.most());
    if (failed == 0) return text;
    return text + fmt::format(
                      " {} of them failed: those whose status is emptied in {} are made again and "
                      "count once.",
                      failed, kRunsInFolder);
  }

  EngineStudy& of_;
  const Engine& engine_;
  const EngineWatch& watch_;
  MakeSettings settings_;
  EngineFacts facts_;
  std::vector<std::string> notes_;
  std::string last_failure_;
  std::size_t asked_ = 0;
};

}  // namespace

namespace {

/// The fresh runs for check_runs in [engine]; missing ones are made, unless no runs are allowed.
/// @throws FitInterrupted
FreshRuns fresh_runs(const EngineStudy& of, const Engine& engine, const MakeSettings& settings,
                     const std::vector<double>& values, std::size_t count) {
  EngineRuns checks(of.study(), of.folder(), RunsFor::check);
  const std::size_t there = checks.rows_at(values).size();
  if (there < count && of.most() > 0) {
    checks.plan({}, std::vector<NextRun>(count - there, {values, "checks the fitted parameters"}));
  }
  std::vector<std::size_t> to_make;
  for (const std::size_t row : checks.rows_at(values)) {
    if (!checks.is_made(row) && of.most() > 0) to_make.push_back(row);
  }
  if (!to_make.empty() && !make_runs(checks, engine, to_make, settings)) throw FitInterrupted();
  if (!checks.exists()) return {};
  const TableRuns table = read_table_runs(of.study(), {checks.file()}, NoRows::allowed);
  FreshRuns fresh;
  std::ranges::copy_if(table.runs, std::back_inserter(fresh.runs),
                       [&](const Run& run) { return run.job.values == values; });
  for (std::size_t k = 0; k < table.places.size(); ++k) {
    fresh.failed += table.places[k] == values && table.ends[k] == RowEnd::failed ? 1 : 0;
  }
  return fresh;
}

}  // namespace

int usual_max_runs(std::size_t parameters) {
  constexpr int kEach = 8, kAll = 16;
  return kAll + kEach * static_cast<int>(parameters);
}

std::optional<StudyResult> calibrate_with_engine(const EngineRequest& request,
                                                 const EngineWatch& watch) {
  EngineStudy of(request);
  const std::unique_ptr<Engine> engine = command_engine(of.study());
  std::error_code error;
  fs::create_directories(of.runs().folder(), error);
  if (error) {
    base::refuse(of.folder(), fmt::format("cannot be made ({})", error.message()),
                 "choose another folder.");
  }
  const base::FolderLock lock(of.folder(), lock_file_in(of.folder()));
  std::vector<std::string> notes;
  note_other_engines(of, *engine, notes);
  if (watch.note) std::ranges::for_each(notes, watch.note);
  static const std::atomic<bool> never = false;
  const std::atomic<bool>& is_interrupted =
      watch.is_interrupted != nullptr ? *watch.is_interrupted : never;
  Rounds rounds(of, *engine, request, watch);
  try {
    const FitWatch fit_watch(is_interrupted);
    if (!rounds.make_all()) return std::nullopt;
  } catch (const FitInterrupted&) {
    return std::nullopt;
  }
  notes.insert(notes.end(), rounds.notes().begin(), rounds.notes().end());
  // If a whole round failed, others would fail as well.
  const auto check_runs =
      rounds.facts().ended_by == kByFailures
          ? std::size_t{0}
          : static_cast<std::size_t>(of.study().engine->check_runs.value_or(kUsualCheckRuns));
  const auto fresh_runs_at = [&](const std::vector<double>& values, bool has_chance) {
    return fresh_runs(of, *engine, rounds.settings(), values,
                      has_chance ? check_runs : std::min<std::size_t>(check_runs, 1));
  };
  return calibrate_table({.study = request.study,
                          .settings = request.settings,
                          .runs = of.tables(),
                          .folder = of.folder(),
                          .engine = rounds.facts(),
                          .notes = notes,
                          .fresh_runs_at = check_runs > 0 ? fresh_runs_at : FreshRunsAt()},
                         watch.note, is_interrupted);
}

EngineForecast forecast_of(const EngineRequest& request) {
  EngineStudy of(request);
  NextRuns next = of.ask();
  return {.made = of.runs().made(),
          .failed = of.runs().failed(),
          .next = next.runs.size(),
          .most = of.most(),
          .run_s = mean_run_s(of.runs()),
          .settled = std::move(next.settled)};
}

}  // namespace repose::calibrate
