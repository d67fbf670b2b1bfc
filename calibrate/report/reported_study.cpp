#include "calibrate/report/reported_study.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "calibrate/experiment/run_result.h"
#include "calibrate/runs/table_columns.h"
#include "calibrate/runs/table_study.h"
#include "calibrate/statistics/table/table.h"
#include "calibrate/study/study_problem.h"
#include "calibrate/study/study_record.h"
#include "dem/state/state_file.h"

namespace repose::calibrate::report {
namespace {

namespace fs = std::filesystem;

std::vector<SavedRun> runs_of(const JointResult& joint) {
  std::vector<SavedRun> runs;
  std::set<double> coarse_sizes;
  for (const SurrogateQuality& surrogate : joint.surrogates) {
    if (surrogate.coarse) coarse_sizes.insert(surrogate.coarse->size);
  }
  for (const Run& run : joint.runs) {
    SavedRun& saved = runs.emplace_back();
    saved.experiment = run.job.experiment;
    saved.readings = run.readings;
    saved.failure = run.failure;
    saved.grain_size = run.job.inputs.size;
    saved.is_coarse = coarse_sizes.contains(saved.grain_size);
    for (std::size_t k = 0; k < run.job.values.size(); ++k) {
      saved.values[joint.parameters[k].name] = run.job.values[k];
    }
  }
  return runs;
}

std::optional<double> if_finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// "heap.base_radius_mm" is a reading of the heap; in a table of runs each reading is its own
/// experiment.
std::vector<MeasuredNumber> measured_in(const JointResult& joint, bool is_of_table) {
  std::vector<MeasuredNumber> numbers;
  for (const ResultObservable& observable : joint.observables) {
    const std::size_t dot = is_of_table ? std::string::npos : observable.name.find('.');
    numbers.push_back(
        {.name = observable.name,
         .experiment = observable.name.substr(0, dot),
         .reading = dot == std::string::npos ? "value" : observable.name.substr(dot + 1),
         .unit = observable.unit,
         .measured = if_finite(observable.measured),
         .uncertainty = if_finite(observable.measured_uncertainty)});
  }
  return numbers;
}

/// A run as RunStore saves it; std::nullopt if the file is damaged.
std::optional<SavedRun> saved_run_in(const fs::path& file) {
  try {
    const RunResult result = run_in(base::read_whole_file(file));
    const auto simulated = nlohmann::json::parse(result.simulated);
    SavedRun run{.experiment = simulated.at("experiment"),
                 .values = {},
                 .readings = readings_of(result),
                 .failure = result.failure,
                 .grain_size = simulated.value("grain_size", 1.)};
    run.is_coarse = run.grain_size != 1;  // unless the study says otherwise
    for (const auto& [pair, contact] : simulated.items()) {
      if (!pair.starts_with("particle_")) continue;
      for (const auto& [name, value] : contact.items()) {
        run.values[fmt::format("contact.{}.{}", pair, name)] = value;
      }
    }
    return run;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  } catch (const base::InputError&) {  // not a readable file
    return std::nullopt;
  }
}

/// Sorted by name, as directory order is undefined.
std::vector<SavedRun> runs_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<SavedRun> runs;
  for (const fs::path& file : files) {
    if (auto run = saved_run_in(file)) runs.push_back(*std::move(run));
  }
  return runs;
}

/// The first prepared run's description of the study; null: none was prepared.
nlohmann::ordered_json first_run_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    files.push_back(entry.path() / "run.json");
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    const auto text = base::read_file_if_there(file);
    if (!text) continue;
    auto run = nlohmann::ordered_json::parse(*text, nullptr, false);
    if (run.is_object() && run.contains("parameters") && run.contains("readings")) return run;
  }
  return nullptr;
}

/// The rows of runs.csv, made by another program: one run for each reading.
void take_made_runs(const fs::path& folder, ReportedStudy& study) {
  const auto first = first_run_in(folder);
  if (first.is_null() || !fs::exists(folder / "runs.csv")) return;
  const calibrate::Table table = read_table(folder / "runs.csv", NoRows::allowed);
  const auto cell = [&](const TableRow& row, const std::string& column) {
    const auto place = table.column(column);
    return place ? row.cells[*place] : std::string();
  };
  MadeRuns& made = study.made.emplace();
  made.study = first.value("study", "");
  for (const TableRow& row : table.rows) {
    const std::string status = in_small_letters(cell(row, "status"));
    bool has_any = false;
    for (const auto& [reading, unit] : first["readings"].items()) {
      has_any = has_any || !is_nothing(in_small_letters(cell(row, reading)));
    }
    if (!has_any && is_nothing(status)) {
      ++made.to_make;
      continue;
    }
    ++made.made;
    made.failed += says_failed(status) || !has_any ? 1 : 0;
    for (const auto& [reading, unit] : first["readings"].items()) {
      SavedRun run{.experiment = reading, .values = {}, .readings = {}, .failure = {}};
      for (const auto& [parameter, value] : first["parameters"].items()) {
        run.values[parameter] = number_of(cell(row, parameter)).value_or(0);
      }
      if (const auto value = number_of(cell(row, reading))) run.readings["value"] = *value;
      if (run.readings.empty()) run.failure = "no number";
      study.runs.push_back(std::move(run));
    }
  }
  for (const auto& [reading, said] : first["readings"].items()) {
    study.measured.push_back({.name = reading,
                              .experiment = reading,
                              .reading = "value",
                              .unit = said.value("unit", ""),
                              .measured = {},
                              .uncertainty = {}});
  }
}

std::optional<StudyRecord> record_in(const fs::path& folder) {
  try {
    return read_study_record(folder);
  } catch (const base::InputError&) {
    return std::nullopt;  // the page is useful without it
  }
}

/// Of a table's study; empty if its copy cannot be read.
dem::StudyHeading table_heading_in(const fs::path& folder) {
  try {
    return heading_of_table_study(folder / kStudyCopy);
  } catch (const base::InputError&) {
    return {};
  }
}

/// What a study without a result will be fitted to, if it can be read.
void take_problem(const StudyRecord& record, ReportedStudy& study) {
  Problem problem;
  try {
    problem = problem_of(record.study, record.grain, record.budget).problem;
  } catch (const base::InputError&) {
    return;  // a page about the runs is useful without it
  }
  for (const Observable& observable : problem.observables) {
    study.measured.push_back({.name = observable.name,
                              .experiment = observable.experiment,
                              .reading = observable.reading,
                              .unit = observable.unit,
                              .measured = observable.mean,
                              .uncertainty = std::nullopt});
    if (!observable.sd) continue;
    study.measured.back().uncertainty =
        with_systematic(observable, standard_uncertainty(observable));
  }
  for (SavedRun& run : study.runs) {
    const auto of_run = std::ranges::find(problem.experiments, run.experiment, &Experiment::name);
    run.is_coarse =
        of_run != problem.experiments.end() && of_run->is_coarse({.size = run.grain_size});
  }
}

/// "contact.PAIR.KEY" and value of each fitted coefficient, as last checked: the heap simulated for
/// that check does not yet include what the fit learned from it.
std::map<std::string, double> values_checked(const StudyResult& result) {
  std::map<std::string, double> values;
  if (const auto* joint = std::get_if<JointResult>(&result.found)) {
    const std::size_t checked = std::min(joint->parameters.size(), joint->agreement.values.size());
    for (std::size_t i = 0; i < checked; ++i) {
      values[joint->parameters[i].name] = joint->agreement.values[i];
    }
  } else {
    const auto& published = std::get<PublishedResult>(result.found);
    values.insert(published.values.begin(), published.values.end());
  }
  return values;
}

/// Whether a heap was simulated with the checked coefficients; true if unknown.
bool is_heap_of(const fs::path& heap, const StudyResult& result) {
  try {
    const auto simulated = nlohmann::json::parse(dem::read_state(heap).provenance_json);
    for (const auto& [name, value] : values_checked(result)) {
      std::string place = name.substr(name.find('.'));
      std::replace(place.begin(), place.end(), '.', '/');
      const nlohmann::json::json_pointer pointer(place);
      constexpr double kSame = 1e-9;
      if (!simulated.contains(pointer)) continue;
      if (std::abs(simulated.at(pointer).get<double>() - value) > kSame) return false;
    }
  } catch (const nlohmann::json::exception&) {
    return true;
  } catch (const base::InputError&) {
    return true;  // errors are reported when it is drawn
  }
  return true;
}

}  // namespace

ReportedStudy reported(const StudyResult& result, const std::vector<PictureReading>& pictures,
                       const fs::path& heap) {
  ReportedStudy study{.folder = {},
                      .record = {},
                      .study = result.provenance.study,
                      .result = result,
                      .heading = {},
                      .runs = {},
                      .made = {},
                      .measured = {},
                      .pictures = pictures,
                      .heap = heap};
  if (const auto* joint = std::get_if<JointResult>(&result.found)) {
    study.runs = runs_of(*joint);
    study.measured = measured_in(*joint, result.provenance.table.has_value());
  }
  return study;
}

ReportedStudy read_reported_study(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    base::refuse(folder, "there is no such folder",
                 "name the folder that repose calibrate --out wrote.");
  }
  const std::optional<StudyNotes> notes = read_study_notes(folder);
  const std::optional<StudyResult> result = read_result(folder);
  if (!notes && !result && !fs::is_directory(folder / "runs", ignored)) {
    base::refuse(folder, "there is no study in it (no study.json, result.json or runs)",
                 "name the folder that repose calibrate --out wrote.");
  }
  const std::vector<PictureReading> pictures =
      notes ? notes->measurement.pictures : std::vector<PictureReading>();
  std::optional<StudyRecord> record = record_in(folder);
  ReportedStudy study;
  if (result && (!notes || is_same_study(result->provenance.study, notes->study))) {
    const fs::path heap = folder / kHeapFile;
    const bool has_heap = fs::exists(heap, ignored);
    const bool is_its = has_heap && is_heap_of(heap, *result);
    study = reported(*result, pictures, is_its ? heap : fs::path());
    study.has_other_heap = has_heap && !is_its;
  } else {
    study.has_other_result = result.has_value();
    if (notes) study.study = notes->study;
    study.runs = runs_in(folder / "runs");
    if (study.runs.empty()) take_made_runs(folder / "runs", study);
    if (record) take_problem(*record, study);
    study.pictures = pictures;
  }
  study.folder = folder;
  if (record) {
    study.heading = record->study.heading;
  } else if (study.result && study.result->provenance.table) {
    study.heading = table_heading_in(folder);
  }
  study.record = std::move(record);
  return study;
}

}  // namespace repose::calibrate::report
