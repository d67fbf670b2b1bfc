#include "cli/calibrate/calibrate_options.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "calibrate/bench/read_bench.h"
#include "calibrate/run/minutes_budget.h"
#include "calibrate/study/executor.h"
#include "calibrate/study/study_record.h"
#include "cli/calibrate/calibrate.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"

namespace repose::cli {

namespace {

constexpr int kMaxJobs = 1024;

/// Runs `work`; input errors are added to `errors`.
template <typename Work>
bool attempt(std::vector<std::string>& errors, const Work& work) {
  try {
    work();
    return true;
  } catch (const base::InputError& error) {
    add_faults(error, errors, kCalibrateFields);
    return false;
  }
}

/// Progress while an experiment's films are tracked.
calibrate::FilmReport shown_progress(std::size_t films) {
  const auto progress = std::make_shared<PartsProgress>(films, "tracked");
  return [progress](std::size_t film, double fraction) { progress->report(film, fraction); };
}

void read_jobs(const CalibrateArguments& arguments, CalibratePlan& plan) {
  plan.threads = plan.record.study.threads.value_or(available_cores());
  if (arguments.jobs.empty()) return;
  const auto jobs = parse_number<int>(arguments.jobs);
  if (!jobs || *jobs < 1 || *jobs > kMaxJobs) {
    plan.errors.push_back(fmt::format(
        "--jobs {}: must be a whole number from 1 to {}. Fix: leave it out to use all cores.",
        arguments.jobs, kMaxJobs));
    return;
  }
  plan.threads = *jobs;
}

/// None of the user's files may be overwritten.
void check_places(CalibratePlan& plan, bool is_dry_run) {
  const dem::Study& study = plan.record.study;
  if (plan.folder.empty()) plan.folder = calibrate::default_folder(study.file);
  if (const auto fault = calibrate::fault_of_folder(plan.folder, study.file)) {
    plan.errors.push_back("--out " + fault->text());
  }
  std::vector<std::filesystem::path> read = files_of(study);
  for (const char* name : {calibrate::kStudyCopy, calibrate::kClumpCopy, calibrate::kNotesFile,
                           calibrate::kResultFile, calibrate::kHeapFile}) {
    read.push_back(plan.folder / name);
  }
  check_output_places({json_place(plan.json_file, is_dry_run ? "\"budgets\"" : "\"hash\""),
                       json_place(plan.progress_file, "\"seconds_left\"", "--progress")},
                      read, plan.errors);
}

/// A dry run shows what the joint method would do, and gives no results.
void check_method(const CalibrateArguments& arguments, CalibratePlan& plan) {
  if (arguments.method != "joint" && arguments.method != "paper") {
    plan.errors.push_back(fmt::format(
        "--method {}: must be joint or paper. Fix: leave it out for joint.", arguments.method));
  }
  if (!arguments.is_dry_run) return;
  if (!plan.record.study.engine.is_own()) {
    plan.errors.push_back(fmt::format(
        "--dry-run: estimates runs of our own engine, not of [engine] program = \"{}\". Fix: leave "
        "it out.",
        plan.record.study.engine.program));
  }
  if (arguments.method != "joint") {
    plan.errors.push_back(
        fmt::format("--dry-run: is for the joint method, not for --method {}, which makes at most "
                    "62 simulations. Fix: leave one of them out.",
                    arguments.method));
  }
}

}  // namespace

CalibratePlan read_bench(const CalibrateArguments& arguments, calibrate::NoRows no_rows) {
  CalibratePlan plan;
  plan.record.settings = arguments.settings;
  plan.folder = arguments.out_folder;
  plan.json_file = arguments.json_file;
  plan.progress_file = arguments.progress_file;
  plan.record.method = arguments.method;
  attempt(plan.errors, [&] { plan.record.budget = calibrate::budget_named(arguments.budget); });
  plan.record.budget.is_full = arguments.fidelity == "full" || arguments.method == "paper";
  if (arguments.fidelity != "full" && arguments.fidelity != "mixed") {
    plan.errors.push_back(
        fmt::format("--fidelity = {}: must be mixed or full. Fix: leave it out for mixed.",
                    arguments.fidelity));
  }
  const bool is_read = attempt(plan.errors, [&] {
    plan.record.study = dem::read_study(arguments.study, arguments.settings);
  });
  read_jobs(arguments, plan);
  if (!is_read) return plan;
  check_places(plan, arguments.is_dry_run);
  attempt(plan.errors, [&] {
    plan.record.measurement = calibrate::read_bench(
        plan.record.study,
        {.no_rows = no_rows, .threads = plan.threads, .watch_films = shown_progress}, plan.notes);
  });
  if (!plan.errors.empty()) return plan;
  attempt(plan.errors, [&] {
    complete_record(plan.record, plan.notes);
    choose_simulator(plan.record);
  });
  return plan;
}

namespace {

/// std::nullopt: --minutes was not given, or cannot be met (see the errors).
std::optional<double> minutes_of(const CalibrateArguments& arguments, CalibratePlan& plan) {
  constexpr double kMin_minutes = .1, kMax_minutes = 1e5;
  if (arguments.minutes.empty()) return std::nullopt;
  const auto refuse = [&](bool is_wrong, const std::string& why) {
    if (is_wrong)
      plan.errors.push_back(fmt::format("--minutes: {}. Fix: leave one of them out.", why));
  };
  refuse(arguments.budget != CalibrateArguments().budget,
         "says all of what the study may cost, and so does --budget");
  refuse(arguments.method != "joint",
         fmt::format("is of the joint method; --method {} always makes the same simulations",
                     arguments.method));
  refuse(calibrate::is_launched_as_rank(),
         "is timed on this machine alone, and mpirun has several processes");
  if (!plan.record.study.engine.is_own()) {
    plan.errors.push_back(
        fmt::format("--minutes: is timed with our own engine, not with [engine] program = \"{}\". "
                    "Fix: --budget.",
                    plan.record.study.engine.program));
  }
  return read_number_within({"--minutes", arguments.minutes, plan.errors}, kMin_minutes,
                            kMax_minutes, "leave it out for --budget quick");
}

calibrate::Budget timed_budget(double minutes, const CalibratePlan& plan) {
  std::optional<Progress> progress;
  return calibrate::budget_of_minutes(minutes, plan, watch_for_interrupt(),
                                      [&](std::size_t done, std::size_t of) {
                                        if (!progress) progress.emplace(of, "timed");
                                        if (done > 0) progress->advance();
                                      });
}

}  // namespace

CalibratePlan plan_calibrate(const CalibrateArguments& arguments) {
  CalibratePlan plan = read_bench(arguments, calibrate::NoRows::refused);
  check_method(arguments, plan);
  const std::optional<double> minutes = minutes_of(arguments, plan);
  if (!plan.errors.empty()) return plan;
  attempt(plan.errors, [&] {
    const auto make_problem = [&] {
      plan.problem =
          calibrate::problem_of(plan.record.study, plan.record.grain, plan.record.budget);
    };
    const bool is_full = plan.record.budget.is_full;
    const auto take = [&](calibrate::Budget budget) {
      plan.record.budget = std::move(budget);
      plan.record.budget.is_full = is_full;
      make_problem();
    };
    if (!minutes) return make_problem();
    take(calibrate::budget_of(*minutes, plan.threads));
    take(timed_budget(*minutes, plan));
  });
  plan.notes.insert(plan.notes.end(), plan.problem.notes.begin(), plan.problem.notes.end());
  return plan;
}

namespace {

constexpr const char* kCalibrateNotes = R"(
STUDY is a study file in which contact coefficients have bounds instead of a
value, as in restitution = { min = 0.1, max = 0.6 }, and experiments state what
was measured. All unknowns are fitted to all measurements at once; each gets an
interval and a verdict: determined, bounded, one-sided, or undetermined by these
data. The best fit is then simulated with fresh seeds; these runs enter the fit too,
and a verdict says whether bench and simulation agree: agrees, disagrees, or
cannot tell.

Simulations are saved in --out: the same command resumes an interrupted study,
and a study with other bounds or measurements reuses them. The same study gives
the same result with any number of --jobs.

Methods:
  joint     all unknowns fitted to all measurements at once, with intervals
  paper     a published calibration procedure: point estimates, for comparison

--minutes N makes as many simulations as are expected to finish within N minutes
on the cores used, checks included, or says how many minutes the smallest fit
takes. Runs are timed once, at the beginning: a resumed study keeps its plan.

Budgets:
  quick     14 minutes on one core for the fit
  standard  125 minutes on one core for the fit
  paper     at most 62 simulations for the fit, as a published calibration
The minutes are estimates for heaps of a few hundred grains; checks are extra.
--dry-run times one run of each experiment, for at most 20 seconds each, and
reports how many simulations each budget takes for what, and how long that is.
It needs the bench readings, and saves nothing.

For heaps of many small grains, most runs use fewer, larger grains in the same
tube; how far off these are is estimated from some runs with the study's own.
All checks are made with the study's own grains or, where one such run would
take longer than the budget for the fit, with the smallest that do not.
--fidelity full uses the study's own grains only.

--rolling-models constant_torque,elastic_plastic calibrates the study with each
of them, in folders of their own, and says which one explains the bench readings
best: their means, and how much they scatter.

With --runs nothing is simulated: STUDY has [parameter] and [measured] instead
of a particle, and RUNS.csv a row for each run of any program, with columns
named after both. Optional columns are seed, status and, for rows that are means
of several runs, n and NAME_sd.

If such a study has [engine] with command = "python3 run.py", repose makes runs
with it: each in a folder below --out, --jobs at once (1), until nothing more
would narrow the answer or --max-runs have been made; then it fits. The same
command resumes after an interruption. --dry-run says how many runs are next and,
once one has been made, how long they take. docs/engines.md describes the
command's input.

Examples:
  repose calibrate study.toml --dry-run
  repose calibrate study.toml
  repose calibrate study.toml --minutes 20
  repose calibrate study.toml --rolling-models constant_torque,elastic_plastic
  repose calibrate study.toml --budget standard --jobs 8 --out hazelnut
  repose calibrate table.toml --runs runs.csv
  repose calibrate with_engine.toml --jobs 2 --max-runs 40
)";

}  // namespace

Command calibrate_command() {
  const auto given = std::make_shared<CalibrateArguments>();
  return {
      .name = "calibrate",
      .summary = "Calibrate a study's coefficients",
      .options =
          {{"study", "STUDY.toml", "Study file", &given->study, true},
           {"--budget", "quick|standard|paper", "Limit on the simulations (quick)", &given->budget},
           {"--minutes", "N", "All of it within N minutes, in place of --budget", &given->minutes},
           {"--fidelity", "mixed|full", "Whether larger grains may make cheaper runs (mixed)",
            &given->fidelity},
           {"--method", "joint|paper", "Method of calibration (joint)", &given->method},
           {"--rolling-models", "A,B", "Fit the study with each, and compare them",
            &given->rolling_models},
           {"--runs", "RUNS.csv", "Fit to runs of another program; repeatable", &given->runs},
           {"--set", "KEY=VALUE", "Replace a value of the study; repeatable", &given->settings},
           {"--max-runs", "N", "Runs that an engine makes at most", &given->max_runs},
           {"--jobs", "N", "Simulations in parallel (all cores)", &given->jobs},
           {"--out", "FOLDER", "Output folder (STUDY_calibration)", &given->out_folder},
           {"--dry-run", "", "Only estimate how long each budget takes", &given->is_dry_run},
           {"--json", "FILE|-", "Full results, for programs", &given->json_file},
           {"--progress", "FILE.json", "How far it is, written over meanwhile",
            &given->progress_file}},
      .notes = kCalibrateNotes,
      .missing = "no study file given. Fix: repose calibrate STUDY.toml.",
      .fields = kCalibrateFields,
      .run = [given] { return run_calibrate(*given); }};
}

}  // namespace repose::cli
