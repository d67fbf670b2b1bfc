#include "cli/plan/plan.h"

#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "base/folder_lock.h"
#include "base/input_error.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/plan/plan.h"
#include "calibrate/study/executor.h"
#include "cli/calibrate/calibrate.h"
#include "cli/calibrate/calibrate_options.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"
#include "cli/plan/plan_table.h"
#include "dem/experiment/experiment_table.h"

namespace repose::cli {

namespace {

constexpr double kMinute_s = 60;

struct PlanOptions {
  CalibratePlan study;  ///< without its problem
  calibrate::OfferedStudy offered;
  int readings = calibrate::kUsualReadings;
  double core_s = 0;
};

/// All experiments, or those typed.
std::set<dem::Experiment> possible_experiments(const std::string& typed,
                                               std::vector<std::string>& errors) {
  if (typed.empty()) return calibrate::every_experiment();
  std::vector<std::string> names;
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) names.emplace_back(entry.name);
  std::set<dem::Experiment> possible;
  for (const std::size_t place : read_words({"--experiments", typed, errors}, names)) {
    possible.insert(&dem::all_experiments()[place]);
  }
  return possible;
}

void offer(double core_s, const std::set<dem::Experiment>& possible, PlanOptions& options) {
  const calibrate::StudyRecord& record = options.study.record;
  try {
    options.offered = calibrate::offered_study(record.study, record.grain,
                                               calibrate::plan_budget(core_s), possible);
  } catch (const base::InputError& error) {
    add_faults(error, options.study.errors);
  }
}

PlanOptions options_of(const PlanArguments& arguments) {
  constexpr int kMaxReadings = 10000;
  constexpr double kMin_minutes = .1, kUsual_minutes = 15, kMax_minutes = 1e5;
  PlanOptions options{.study = read_bench({.study = arguments.study,
                                           .settings = arguments.settings,
                                           .rolling_models = {},
                                           .jobs = arguments.jobs,
                                           .out_folder = arguments.out_folder,
                                           .json_file = arguments.json_file},
                                          calibrate::NoRows::allowed),
                      .offered = {}};
  std::vector<std::string>& errors = options.study.errors;
  if (!options.study.record.study.engine.is_own()) {
    errors.emplace_back(
        "[engine]: plans are made by our own engine. Fix: --set 'engine.program=\"repose\"', which "
        "says nearly the same of other programs.");
  }
  if (const auto readings = read_whole_number({"--readings", arguments.readings, errors}, 1,
                                              kMaxReadings, "leave it out for 10")) {
    options.readings = *readings;
  }
  const auto minutes = read_number_within({"--minutes", arguments.minutes, errors}, kMin_minutes,
                                          kMax_minutes, "leave it out for 15");
  const std::set<dem::Experiment> possible = possible_experiments(arguments.experiments, errors);
  options.core_s = kMinute_s * minutes.value_or(kUsual_minutes);
  if (errors.empty()) offer(options.core_s, possible, options);
  return options;
}

std::optional<calibrate::Plan> plan_of(const PlanOptions& options,
                                       const calibrate::RunStore& folder) {
  calibrate::StudySimulator simulator(options.offered.study, options.study.record.grain,
                                      options.offered.problem.parameters);
  simulator.store_in(folder);
  calibrate::ThreadExecutor executor(simulator, options.study.threads);
  StudyProgressLine line;
  return make_plan(options.offered,
                   {simulator, folder, executor, watch_for_interrupt(),
                    [&](const calibrate::StudyProgress& progress) { line.report(progress); }},
                   options.readings);
}

}  // namespace

ExitCode run_plan(const PlanArguments& arguments) {
  const PlanOptions options = options_of(arguments);
  print_lines(options.study.errors);
  if (!options.study.errors.empty()) return ExitCode::bad_input;
  print_lines(options.study.notes);
  print_line(foreseen(options.offered, options.core_s));
  const calibrate::RunStore folder(options.study.folder);
  const base::FolderLock lock(options.study.folder, calibrate::lock_file_in(options.study.folder));
  const std::optional<calibrate::Plan> plan = plan_of(options, folder);
  print_lines(folder.remarks());
  if (!plan) {
    print_line(
        fmt::format("interrupted; there is no plan yet. The same command resumes from here: "
                    "the simulations are in {}.",
                    folder.runs().string()));
    return ExitCode::interrupted;
  }
  print_lines(plan->notes);
  Outputs outputs;
  outputs.add(options.study.json_file, plan_json(*plan, options.offered));
  outputs.show(plan_table(*plan, options.offered, columns_of(stdout)));
  outputs.write();
  return ExitCode::done;
}

namespace {

constexpr const char* kPlanNotes = R"(
Which experiments would determine the coefficients that a study seeks? Simulates
every experiment that repose offers, those of the study as it describes them and
the others with their usual settings, throughout the bounds of the coefficients,
and prints
  - what each experiment is sensitive to: by how many of its uncertainties its
    mean reading changes while a coefficient goes from bound to bound
  - the smallest set of experiments that would determine what is open, and the
    expected 95 % interval of each coefficient
  - what to add to the study for them
Experiments with readings in the study count as done; no readings are needed.

Simulations are saved in --out: an interrupted plan is resumed by the same
command, and repose calibrate uses them too.

Examples:
  repose plan study.toml
  repose plan study.toml --experiments pendulum,fill,draw_down --readings 20
)";

}  // namespace

Command plan_command() {
  const auto given = std::make_shared<PlanArguments>();
  return {
      .name = "plan",
      .summary = "Find out which experiments to do",
      .options =
          {{"study", "STUDY.toml", "Study file", &given->study, true},
           {"--set", "KEY=VALUE", "Replace a value of the study; repeatable", &given->settings},
           {"--experiments", "A,B,...", "Experiments that you could do (all)", &given->experiments},
           {"--readings", "N", "Readings of each experiment to be done (10)", &given->readings},
           {"--minutes", "M", "Simulate for about M minutes of one core (15)", &given->minutes},
           {"--jobs", "N", "Simulations in parallel (all cores)", &given->jobs},
           {"--out", "FOLDER", "Output folder (STUDY_calibration)", &given->out_folder},
           {"--json", "FILE|-", "The plan, for programs", &given->json_file}},
      .notes = kPlanNotes,
      .missing = "no study file given. Fix: repose plan STUDY.toml.",
      .run = [given] { return run_plan(*given); }};
}

}  // namespace repose::cli
