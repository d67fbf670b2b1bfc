#include "cli/simulate/simulate_options.h"

#include <array>
#include <limits>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>

#include "base/input_error.h"
#include "calibrate/bench/bench_readings.h"
#include "calibrate/experiment/heap_angle.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/simulators/simulators.h"
#include "calibrate/statistics/summary.h"
#include "calibrate/study/impossible_readings.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/simulate/simulate_runs.h"
#include "dem/experiment/experiment_table.h"

namespace repose::cli {
namespace {

constexpr int kMaxRepeats = 100'000;
constexpr std::array kSimulateFields{base::FieldName{"setting", "--set"}};
constexpr int kMaxViews = 360;

/// The whole text as a number from `least` to `most`; otherwise adds an error. std::nullopt if
/// empty.
template <typename Number>
std::optional<Number> number_of(const std::string& option, const std::string& text, Number least,
                                Number most, const std::string& fix, SimulatePlan& plan) {
  if (text.empty()) return std::nullopt;
  const auto number = parse_number<Number>(text);
  if (number && *number >= least && *number <= most) return number;
  plan.errors.push_back(fmt::format("{} {}: must be a {}number from {} to {}. Fix: {}.", option,
                                    text, std::is_integral_v<Number> ? "whole " : "", least, most,
                                    fix));
  return std::nullopt;
}

void read_numbers(const SimulateArguments& arguments, SimulatePlan& plan) {
  const std::uint64_t seed =
      number_of<std::uint64_t>("--seed", arguments.seed, 0,
                               std::numeric_limits<std::int64_t>::max(), "--seed 1", plan)
          .value_or(plan.study.seed);
  const int repeats = number_of("--repeats", arguments.repeats, 1, kMaxRepeats, "--repeats 5", plan)
                          .value_or(plan.study.replicates);
  for (int k = 0; k < repeats; ++k) plan.seeds.push_back(seed + static_cast<std::uint64_t>(k));
  plan.threads = number_of("--threads", arguments.threads, 1, kMaxThreads,
                           "leave it out to use all cores", plan)
                     .value_or(plan.study.threads.value_or(available_cores()));
  constexpr double kShortest_s = 1e-9, kLongest_s = 1e6;
  plan.trajectory_s = number_of("--trajectory-s", arguments.trajectory_s, kShortest_s, kLongest_s,
                                "--trajectory-s 0.1", plan);
  if (!arguments.trajectory_s.empty() && arguments.out_folder.empty()) {
    plan.errors.emplace_back(
        "--trajectory-s: needs a folder for its frames. Fix: add --out FOLDER.");
  }
}

void read_views(const SimulateArguments& arguments, SimulatePlan& plan) {
  if (plan.experiment->is_pictured) {
    plan.views = number_of("--views", arguments.views, 0, kMaxViews,
                           "--views 9, or 1 for the XZ view alone", plan)
                     .value_or(calibrate::kHeapViews);
  } else if (!arguments.views.empty()) {
    plan.errors.emplace_back("--views: only heaps are measured in pictures. Fix: leave it out.");
  }
}

/// The experiment must be described, and everything it needs must have a value.
void check_study(SimulatePlan& plan) {
  const std::string file = plan.study.file.string();
  const dem::ExperimentEntry& entry = *plan.experiment;
  const std::string_view name = entry.name;
  if (!dem::has_protocol(plan.study, plan.experiment)) {
    plan.errors.push_back(fmt::format(
        "{}: section [experiment.{}] is missing. Fix: add it to the study, or for this run "
        "--set 'experiment.{}={{}}' for the usual way of doing it.",
        file, name, name));
  }
  for (const std::string& key : dem::open_coefficients(plan.study, plan.experiment)) {
    plan.errors.push_back(
        fmt::format("{}: {} has bounds but no value, which a simulation needs. Fix: --set {}=0.3, "
                    "or fit it with "
                    "repose calibrate.",
                    file, key, key));
  }
  const double stiffness = dem::model_for(plan.study, plan.experiment).stiffness_factor;
  if (stiffness != 1 && !entry.softening_effect.empty()) {
    plan.notes.push_back(fmt::format(
        "{}: a {} with stiffness_factor = {:g} {}. Fix: take it out of [experiment.{}].", file,
        name, stiffness, entry.softening_effect, name));
  }
}

void check_places(SimulatePlan& plan) {
  std::vector<OutputPlace> places = {json_place(plan.json_file, "\"repeats\"")};
  if (!plan.out_folder.empty() && make_output_folder("--out", plan.out_folder, plan.errors)) {
    places.push_back({"--out", result_file(plan).string()});
    places.push_back({"--out", (plan.out_folder / "run.json").string()});
  }
  check_output_places(places, dem::files_of(plan.study), plan.errors);
}

/// From here on no other process writes into the folder.
void lock_folder(SimulatePlan& plan) {
  if (plan.out_folder.empty() || !plan.errors.empty()) return;
  try {
    const calibrate::RunStore folder(plan.out_folder);
    plan.lock.emplace(plan.out_folder, calibrate::lock_file_in(plan.out_folder));
  } catch (const base::InputError& error) {
    plan.errors.push_back(fmt::format("--out {}", error.what()));
  }
}

/// The folder's content can be continued if it is of the same run.
void check_saved(SimulatePlan& plan) {
  const std::string error = error_of_saved(plan);
  if (!error.empty()) plan.errors.push_back(error);
}

/// std::nullopt if the air makes no difference, or nothing was measured. Impossible readings only
/// give notes, since a simulation needs none.
std::optional<double> mean_without_air(SimulatePlan& plan) {
  if (!plan.experiment->is_in_air) return std::nullopt;
  try {
    const dem::Measured measured =
        dem::measured_in(calibrate::without_air(plan.study, plan.grain.shape), plan.experiment);
    const auto is_of_air = [](const dem::Systematic& part) {
      return part.name == calibrate::kAirPart;
    };
    if (std::ranges::none_of(measured.systematic, is_of_air)) return std::nullopt;
    return measured.mean ? measured.mean : calibrate::summarise(measured.values).mean;
  } catch (const base::InputError& error) {
    add_faults(error, plan.notes);
    return std::nullopt;
  }
}

/// Chooses the program that makes the runs.
void choose_simulator(SimulatePlan& plan) {
  try {
    plan.spec.simulator = calibrate::simulator_for(plan.study);
    for (const base::Fault& fault : plan.spec.simulator->refusals(plan.spec)) {
      plan.errors.push_back(fault.text());
    }
  } catch (const base::InputError& error) {
    add_faults(error, plan.errors);
    return;
  }
  if (plan.trajectory_s && !plan.spec.simulator->can_resume()) {
    plan.errors.push_back(fmt::format(
        "--trajectory-s: {} makes no films. Fix: leave it out, or simulate with our own "
        "engine.",
        plan.spec.simulator->title()));
  }
}

void build_bench(SimulatePlan& plan) {
  try {
    plan.grain = dem::build_grain(plan.study.grain);
    plan.mean_without_air = mean_without_air(plan);
  } catch (const base::InputError& error) {
    add_faults(error, plan.errors);
    return;
  }
  for (const base::Fault& fault : calibrate::impossible_readings(plan.study, plan.grain.shape)) {
    plan.errors.push_back(fault.text());
  }
  for (const std::string& repair : plan.grain.repairs) {
    plan.notes.push_back(fmt::format("{}: {}", plan.grain.source, repair));
  }
  const std::string shape = dem::warning_of_shape(plan.grain);
  if (!shape.empty()) plan.notes.push_back(shape);
  plan.spec = calibrate::spec_of(plan.study, plan.experiment, calibrate::NamedGrain(plan.grain),
                                 plan.views);
  choose_simulator(plan);
  if (!plan.errors.empty()) return;
  const std::vector<std::string> saved = notes_on_saved(plan);
  plan.notes.insert(plan.notes.end(), saved.begin(), saved.end());
}

}  // namespace

SimulatePlan plan_simulate(const SimulateArguments& arguments) {
  SimulatePlan plan;
  plan.settings = arguments.settings;
  // Corresponds to [engine] in the study; the option overrides it.
  if (!arguments.engine.empty()) {
    plan.settings.push_back(fmt::format("engine.program=\"{}\"", arguments.engine));
  }
  if (!arguments.processes.empty()) {
    plan.settings.push_back("engine.processes=" + arguments.processes);
  }
  plan.out_folder = arguments.out_folder;
  plan.json_file = arguments.json_file;
  const dem::ExperimentEntry* experiment = dem::find_experiment(arguments.experiment);
  if (experiment == nullptr) {
    plan.errors.push_back(fmt::format("simulate {}: unknown experiment. Fix: {}.",
                                      arguments.experiment, dem::experiment_names()));
  } else {
    plan.experiment = experiment;
  }
  bool is_read = false;
  try {
    plan.study = dem::read_study(arguments.study, plan.settings);
    is_read = true;
    // A simulation needs no readings: they are only for comparison, if there are any.
    const auto sheets = calibrate::read_sheets(plan.study, calibrate::NoRows::allowed);
    for (const calibrate::SheetReadings& sheet : sheets) {
      plan.notes.insert(plan.notes.end(), sheet.notes.begin(), sheet.notes.end());
    }
    plan.study = with_readings(plan.study, sheets);
  } catch (const base::InputError& error) {
    add_faults(error, plan.errors, kSimulateFields);
  }
  read_numbers(arguments, plan);
  if (experiment != nullptr) read_views(arguments, plan);
  if (is_read && experiment != nullptr) check_study(plan);
  check_places(plan);
  if (is_read && experiment != nullptr) check_saved(plan);
  lock_folder(plan);
  // Another process may have finished meanwhile.
  if (plan.lock) check_saved(plan);
  if (plan.errors.empty()) build_bench(plan);
  return plan;
}

}  // namespace repose::cli
