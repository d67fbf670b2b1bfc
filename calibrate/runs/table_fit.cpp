#include "calibrate/runs/table_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <system_error>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/atomic_file.h"
#include "base/distributions.h"
#include "base/fingerprint.h"
#include "base/folder_lock.h"
#include "base/input_error.h"
#include "base/version.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/fit/agreement.h"
#include "calibrate/fit/fit_watch.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/prediction.h"
#include "calibrate/fit/solution.h"
#include "calibrate/fit/surrogate.h"
#include "calibrate/fit/verification.h"
#include "calibrate/fit/warnings.h"
#include "calibrate/result/result_of.h"
#include "calibrate/result/result_text.h"
#include "calibrate/run/run_study.h"
#include "calibrate/runs/odd_readings.h"
#include "calibrate/study/study_record.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

StudyIdentity identity_of(const TableStudy& study, const TableRuns& table) {
  std::vector<std::string> parts = {study.text};
  parts.insert(parts.end(), study.settings.begin(), study.settings.end());
  for (const fs::path& sheet : study.sheets) parts.push_back(base::read_whole_file(sheet));
  parts.insert(parts.end(), table.texts.begin(), table.texts.end());
  return {.program = base::kProgram,
          .file = study.file.filename().string(),
          .hash = base::fingerprint(parts),
          .settings = study.settings,
          .method = "joint",
          .budget = {},
          .budget_description = {}};
}

/// Prediction of the surface through the runs of a held-out reading at the coefficients that the
/// fit finds plausible.
Prediction predicted(const Problem& problem, const Observable& observable, const Solution& solution,
                     const std::vector<Run>& runs) {
  const Experiment& experiment = experiment_named(problem, observable.experiment);
  const TrainingSet training_set = training_set_of(problem, experiment, observable.reading, runs);
  Surrogate surrogate(training_set, {}, true);
  surrogate.inflate_near(solution.best.point);
  const std::vector<Point>& sets = solution.sets.points;
  const auto count = static_cast<double>(sets.size());
  double mean = 0, squares = 0, surface2 = 0;
  for (const Point& point : sets) {
    const double reading = surrogate.simulated(point);
    mean += reading / count;
    squares += reading * reading / count;
    surface2 += std::pow(surrogate.uncertainty(point), 2) / count;
  }
  const double by_coefficients = std::max(0., squares - mean * mean);
  const std::size_t dimensions = problem.parameters.size();
  const Interval possible = {std::clamp(extreme_of(surrogate, dimensions, false).reading,
                                        observable.least, observable.most),
                             std::clamp(extreme_of(surrogate, dimensions, true).reading,
                                        observable.least, observable.most)};
  const Margin margin = margin_of(observable, possible);
  Prediction prediction{
      .name = observable.name,
      .unit = observable.unit,
      .measured = observable.mean,
      .measured_uncertainty = with_systematic(observable, standard_uncertainty(observable)),
      .predicted = mean,
      .uncertainty = 0,
      .interval = {},
      .coefficients_sd = std::sqrt(by_coefficients),
      .run_sd = surrogate.warp().scatter(surrogate.at(solution.best.point, false).mean),
      .model_sd = solution.misfit.model_scale() * observable.model_sd,
      .difference_sigma = 0,
      .chance = 0,
      .tolerance = margin.value,
      .tolerance_from = margin.source,
      .possible = possible,
      .sets = static_cast<int>(sets.size()),
      .failed_runs = attempts_of(problem, experiment, runs).failures()};
  judge(problem, observable,
        {mean, std::sqrt(by_coefficients + surface2), std::numeric_limits<double>::infinity()},
        prediction);
  return prediction;
}

/// "aor 27.1 ± 0.4 deg for the measured 27 ± 1.5".
std::string surfaces_text(const JointFit& fit) {
  std::string text;
  for (const FittedObservable& one : fit.observables) {
    text +=
        fmt::format("{}{} {:.4g} ± {:.2g}{} for the measured {:.4g} ± {:.2g}",
                    text.empty() ? "" : ", ", one.name, one.simulated, one.simulated_uncertainty,
                    one.unit.empty() ? "" : " " + one.unit, one.measured, one.measured_uncertainty);
  }
  return text;
}

/// Whether the best fit misses a reading by more than chance does in one of a hundred tables.
bool misses_a_reading(const JointFit& fit) {
  constexpr double kNormal99 = 2.576;
  return std::ranges::any_of(fit.observables, [](const FittedObservable& one) {
    return std::abs(one.difference_sigma) > kNormal99;
  });
}

/// @param has_engine  the study's command makes runs
std::string unchecked_text(const JointFit& fit, const std::vector<OddReading>& odd,
                           bool has_engine) {
  if (misses_a_reading(fit)) {
    std::string first;
    for (const OddReading& one : odd) {
      first += fmt::format("{}{}", first.empty() ? "first look at " : "; and ", one.text());
    }
    if (!first.empty()) first += ": a slip there leads the surfaces astray. As it is, ";
    return first +
           fmt::format(
               "no parameters within the bounds give these readings: the nearest give {} (standard "
               "uncertainties), and say nothing of the material. Check units and columns of the "
               "table and "
               "of [measured]; else widen the bounds and add runs there",
               surfaces_text(fit));
  }
  return fmt::format(
      "the fit rests on surfaces through the table's runs, which give {} (standard uncertainties) "
      "at the fitted parameters. To check them, {}",
      surfaces_text(fit),
      has_engine ? "allow check_runs in [engine], or --max-runs, and give the same command again"
                 : "run them with your program, add the row to the table, and calibrate again");
}

void note_odd(const std::vector<OddReading>& odd, std::vector<std::string>& notes) {
  for (const OddReading& one : odd) {
    notes.push_back(fmt::format(
        "{}. It counts, and widens what is known of {}. If the reading or a parameter of that row "
        "is a slip, correct it; if the run went wrong, write failed in place of the reading.",
        one.text(), one.name));
  }
}

/// Adds the results of fresh runs at the fitted parameters, if each reading has enough of them.
void add_check(const Problem& problem, const JointFit& fit, const FreshRunsAt& fresh_runs_at,
               EngineFacts& engine, JointResult& joint) {
  const auto has_chance = [](const FittedObservable& one) { return one.simulated_sd > 0; };
  const bool has_any = std::ranges::any_of(fit.observables, has_chance);
  std::vector<double> values;
  for (const FittedParameter& parameter : fit.parameters) values.push_back(parameter.value);
  const FreshRuns fresh = fresh_runs_at(values, has_any);
  Problem checked = problem;
  bool is_enough = true;
  for (std::size_t i = 0; i < problem.observables.size(); ++i) {
    const std::string& name = problem.observables[i].experiment;
    const auto readings =
        std::ranges::count(fresh.runs, name, [](const Run& run) { return run.job.experiment; });
    is_enough = is_enough && readings >= (has_any ? 2 : 1);
    for (Experiment& experiment : checked.experiments) {
      if (experiment.name == name) experiment.is_stochastic = has_any;
    }
  }
  std::set<std::uint64_t> seeds;
  for (const Run& run : fresh.runs) seeds.insert(run.job.seed);
  engine.check_runs = static_cast<int>(seeds.size()) + fresh.failed;
  engine.check_failed = fresh.failed;
  if (fresh.failed > 0) {
    joint.warnings.push_back(fmt::format(
        "{} of {} runs at the fitted parameters failed, and say nothing of them. Those whose "
        "status is emptied in runs/checks.csv are made again.",
        fresh.failed, engine.check_runs));
  }
  if (!is_enough) return;
  const Verification check = verify(checked, values, fresh.runs, &fit, &fit.freedom);
  const std::vector<SurrogateCheck> surfaces = check_surrogates(checked, fit, fresh.runs);
  for (std::size_t i = 0; i < joint.observables.size(); ++i) {
    joint.observables[i].verification = check.observables[i];
    joint.observables[i].surrogate = surfaces[i];
    if (!surfaces[i].misses) continue;
    joint.warnings.push_back(fmt::format(
        "{}: the surface missed its own check: at the fitted parameters it expected {:.4g} ± "
        "{:.2g} "
        "(95 %), and fresh runs gave {:.4g}. More runs near there would mend it: a higher "
        "--max-runs, or these with --runs, whose table is runs/checks.csv.",
        surfaces[i].observable, surfaces[i].predicted, base::kNormal95 * surfaces[i].uncertainty,
        surfaces[i].simulated));
  }
  joint.verdict = check.verdict;
  joint.agreement = {.text = agreement_text(check, fit.freedom.degrees),
                     .chance = check.chance,
                     .rounds = 1,
                     .values = values};
}

/// Notes a parameter that is the same in all rows.
void note_constant(const TableStudy& study, const TableRuns& table,
                   std::vector<std::string>& notes) {
  for (std::size_t j = 0; j < study.parameters.size(); ++j) {
    const auto is_first = [&](const std::vector<double>& place) {
      return place[j] == table.places.front()[j];
    };
    if (table.places.empty() || !std::ranges::all_of(table.places, is_first)) continue;
    notes.push_back(fmt::format(
        "{} is {:g} in all rows: they say nothing of it. Fix: add rows with other values, or leave "
        "it out of [parameter].",
        study.parameters[j].name, table.places.front()[j]));
  }
}

/// Notes bounds that extend far beyond the rows with readings.
void note_extrapolation(const TableStudy& study, const TableRuns& table,
                        std::vector<std::string>& notes) {
  constexpr double kFar = .1;  // of the bounds' distance
  for (std::size_t j = 0; j < study.parameters.size() && !table.places.empty(); ++j) {
    const Parameter& parameter = study.parameters[j];
    double low = parameter.max, high = parameter.min;
    for (const Run& run : table.runs) {
      if (run.readings.empty()) continue;
      low = std::min(low, run.job.values[j]);
      high = std::max(high, run.job.values[j]);
    }
    if (low > high) return;  // no run has a reading
    const double far = kFar * (parameter.max - parameter.min);
    if (low == high || (low - parameter.min < far && parameter.max - high < far)) continue;
    notes.push_back(fmt::format(
        "{0}: the rows are from {1:g} to {2:g}, the bounds {3:g} and {4:g}. Beyond the rows all is "
        "extrapolated, equally good sets too. Fix: rows there, or bounds {1:g} and {2:g}.",
        parameter.name, low, high, parameter.min, parameter.max));
  }
}

/// If no parameters give the readings, there is no interval of those that do.
void withdraw_intervals(const Problem& problem, JointFit& fit) {
  for (std::size_t j = 0; j < fit.parameters.size(); ++j) {
    FittedParameter& parameter = fit.parameters[j];
    parameter.interval = {problem.parameters[j].min, problem.parameters[j].max};
    parameter.verdict = Verdict::undetermined;
    parameter.advice = "no parameters within the bounds give all readings: see why first";
  }
  fit.equivalence_family.clear();
}

}  // namespace

Problem problem_of(const TableStudy& study, const TableRuns& table) {
  Problem problem;
  problem.parameters = study.parameters;
  problem.observables = study.measured;
  problem.held_out = study.held_out;
  std::vector<std::size_t> all;
  for (std::size_t j = 0; j < study.parameters.size(); ++j) all.push_back(j);
  for (const std::string& reading : readings_of(study)) {
    problem.experiments.push_back({.name = reading, .parameters = all});
  }
  problem.offers = table.others;
  // Nothing is simulated: there is no budget.
  problem.settings.are_runs_given = true;
  problem.settings.budget_s = 1e9;
  problem.settings.max_jobs = 1'000'000;
  return problem;
}

std::size_t fewest_places(const Problem& problem) { return 2 * problem.parameters.size() + 2; }

std::vector<base::Fault> too_few_places(const Problem& problem, const TableRuns& table) {
  std::vector<base::Fault> faults;
  for (const Experiment& experiment : problem.experiments) {
    std::set<std::vector<double>> places;
    for (const Run& run : table.runs) {
      if (run.job.experiment == experiment.name && run.failure.empty()) {
        places.insert(run.job.values);
      }
    }
    const std::size_t fewest = fewest_places(problem);
    if (places.size() >= fewest) continue;
    faults.push_back(
        {.where = fmt::format("{}", fmt::join(table.files, ", ")),
         .subject = experiment.name,
         .value = fmt::format("has readings at {} different places, of {} rows{}", places.size(),
                              table.rows,
                              table.left_out == 0 ? ""
                                                  : fmt::format(" ({} more are outside the bounds, "
                                                                "or copies)",
                                                                table.left_out)),
         .rule = fmt::format("{} at least for {} parameters", fewest, problem.parameters.size()),
         .fix = "make more runs; repose ask STUDY.toml --runs runs.csv says where."});
  }
  return faults;
}

namespace {

/// How to add runs that an engine makes.
std::string more_runs_text(const EngineFacts& engine) {
  std::string text = "make more runs, with a higher --max-runs";
  if (engine.failed == 0) return text + '.';
  return text + fmt::format(
                    "; {} of {} failed: those whose status is emptied in runs/runs.csv are made "
                    "again.",
                    engine.failed, engine.runs);
}

/// @param engine  that makes the runs; std::nullopt: made by hand
Problem sound_problem_of(const TableStudy& study, const TableRuns& table,
                         const std::optional<EngineFacts>& engine) {
  Problem problem = problem_of(study, table);
  base::Faults faults;
  for (base::Fault fault : too_few_places(problem, table)) {
    if (engine) fault.fix = more_runs_text(*engine);
    faults.add(std::move(fault));
  }
  faults.throw_if_any();
  require_sound(problem);
  return problem;
}

/// The same lock as for studies that repose simulates itself: a folder belongs to one or the other.
base::FolderLock locked(const fs::path& folder) {
  const fs::path file = lock_file_in(folder);
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) {
    base::refuse(folder, fmt::format("cannot be made ({})", error.message()),
                 "choose another folder.");
  }
  return {folder, file};
}

}  // namespace

StudyResult fit_table(const TableStudy& study, const TableRuns& table,
                      const std::optional<EngineFacts>& made_by, const FreshRunsAt& fresh_runs_at) {
  std::optional<EngineFacts> engine = made_by;
  const Problem problem = sound_problem_of(study, table, engine);
  const std::vector<Run> runs = in_order(problem, table.runs);
  const Solution solution = solve(problem, runs);
  JointFit fit = fit_of(problem, runs, solution, {});
  // The table does not say how long a run takes.
  for (FittedParameter& parameter : fit.parameters) {
    if (parameter.narrowing) parameter.narrowing->hour.reset();
  }
  const bool gives_readings = !misses_a_reading(fit);
  if (!gives_readings) withdraw_intervals(problem, fit);
  JointResult joint = fitted_result(problem, fit, runs);
  joint.is_of_table = true;
  const std::vector<OddReading> odd = odd_readings(problem, table);
  joint.agreement.text = unchecked_text(fit, odd, engine.has_value());
  for (const Observable& observable : problem.held_out) {
    joint.held_out.push_back(predicted(problem, observable, solution, runs));
  }
  joint.warnings = study.notes;
  joint.warnings.insert(joint.warnings.end(), table.notes.begin(), table.notes.end());
  note_odd(odd, joint.warnings);
  note_constant(study, table, joint.warnings);
  note_extrapolation(study, table, joint.warnings);
  joint.warnings.insert(joint.warnings.end(), fit.warnings.begin(), fit.warnings.end());
  if (engine && fresh_runs_at && gives_readings) {
    add_check(problem, fit, fresh_runs_at, *engine, joint);
  }
  return {.provenance = {.study = identity_of(study, table),
                         .model = {},
                         .table = TableFacts{.files = table.files,
                                             .rows = table.rows,
                                             .failed = table.failed,
                                             .without_reading = table.without_reading,
                                             .left_out = table.left_out,
                                             .engine = engine}},
          .found = std::move(joint)};
}

std::optional<StudyResult> calibrate_table(const TableRequest& request,
                                           const std::function<void(const std::string&)>& note,
                                           const std::atomic<bool>& is_interrupted) {
  base::Faults faults;
  const fs::path folder = request.folder.empty() ? default_folder(request.study) : request.folder;
  if (auto fault = fault_of_folder(folder, request.study)) faults.add(std::move(*fault));
  std::optional<TableStudy> study;
  std::optional<TableRuns> table;
  try {
    study = read_table_study(request.study, request.settings);
    table = read_table_runs(*study, request.runs);
  } catch (const base::InputError& error) {
    faults.add_all(error.faults());
  }
  faults.throw_if_any();
  sound_problem_of(*study, *table, request.engine);  // before a folder is made
  std::optional<base::FolderLock> lock;              // whoever made the runs already holds it
  if (!request.engine) lock.emplace(locked(folder));
  std::optional<StudyResult> result;
  try {
    const FitWatch watch(is_interrupted);
    result = fit_table(*study, *table, request.engine, request.fresh_runs_at);
  } catch (const FitInterrupted&) {
    return std::nullopt;
  }
  std::vector<std::string>& warnings = std::get<JointResult>(result->found).warnings;
  warnings.insert(warnings.begin(), request.notes.begin(), request.notes.end());
  const StudyIdentity& identity = result->provenance.study;
  set_aside_old_result(folder, identity, note);
  write_study_files(folder, {.study = identity, .measurement = {}, .fingerprints = {}},
                    {{kStudyCopy, study->text}});
  base::write_whole_file(folder / kResultFile, to_json(*result));
  if (note) {
    for (const std::string& text : std::get<JointResult>(result->found).warnings) note(text);
  }
  return result;
}

}  // namespace repose::calibrate
