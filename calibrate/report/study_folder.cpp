#include "calibrate/report/study_folder.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "calibrate/study/study_problem.h"
#include "calibrate/study/study_record.h"

namespace repose::calibrate::report {
namespace {

namespace fs = std::filesystem;

std::map<std::string, double> numbers_of(const JsonView& object) {
  std::map<std::string, double> numbers;
  for (const auto& [name, value] : object.members()) {
    if (const auto number = value.number()) numbers[name] = *number;
  }
  return numbers;
}

std::vector<SavedRun> runs_of_result(const JsonView& result) {
  std::vector<SavedRun> runs;
  for (const JsonView& run : result["runs"].items()) {
    runs.push_back({.experiment = run["experiment"].text(),
                    .values = numbers_of(run["values"]),
                    .readings = numbers_of(run["readings"]),
                    .failure = run["failure"].text()});
  }
  return runs;
}

SavedRun run_of_file(const JsonView& file) {
  const JsonView simulated = file["simulated"];
  SavedRun run{.experiment = simulated["experiment"].text(),
               .values = {},
               .readings = numbers_of(file["readings"]),
               .failure = file["failure"].text()};
  for (const std::string pair : {"particle_wall", "particle_particle"}) {
    for (const auto& [name, value] : numbers_of(simulated[pair])) {
      run.values["contact." + pair + '.' + name] = value;
    }
  }
  return run;
}

/// In the order of their names: folders have none.
std::vector<SavedRun> runs_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<SavedRun> runs;
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    SavedRun run = run_of_file(JsonView::of_text({std::istreambuf_iterator<char>(in), {}}));
    if (!run.experiment.empty()) runs.push_back(std::move(run));
  }
  return runs;
}

MeasuredNumber measured_of(const JsonView& observable) {
  MeasuredNumber number{.name = observable["name"].text(),
                        .experiment = {},
                        .reading = "value",
                        .unit = observable["unit"].text(),
                        .measured = observable["measured"].number(),
                        .uncertainty = observable["measured_uncertainty"].number()};
  const std::size_t dot = number.name.find('.');
  number.experiment = number.name.substr(0, dot);
  if (dot != std::string::npos) number.reading = number.name.substr(dot + 1);
  return number;
}

/// What a study without a result is to be fitted to, as far as it can be read.
std::vector<MeasuredNumber> measured_of_record(const fs::path& folder) {
  std::vector<MeasuredNumber> numbers;
  try {
    const StudyRecord record = read_study_record(folder);
    for (const Observable& observable :
         problem_of(record.study, record.grain, record.budget).problem.observables) {
      numbers.push_back({.name = observable.name,
                         .experiment = observable.experiment,
                         .reading = observable.reading,
                         .unit = observable.unit,
                         .measured = observable.mean,
                         .uncertainty = std::nullopt});
      if (observable.sd) numbers.back().uncertainty = standard_uncertainty(observable);
    }
  } catch (const std::invalid_argument&) {
    // A page about the runs is worth having without it.
    numbers.clear();
  }
  return numbers;
}

/// The same study file, settings, method and budget.
bool is_of(const JsonView& result, const JsonView& study) {
  if (!study.exists()) return true;
  const JsonView provenance = result["provenance"];
  const auto same = [](const JsonView& a, const JsonView& b) {
    return !a.exists() || !b.exists() || a.shown() == b.shown();
  };
  return same(provenance["study"]["hash"], study["study"]["hash"]) &&
         same(provenance["study"]["settings"], study["study"]["settings"]) &&
         same(result["method"], study["method"]) &&
         same(provenance["budget"]["name"], study["budget"]["name"]);
}

}  // namespace

bool StudyFolder::is_paper_way() const {
  const JsonView method = is_finished() ? result["method"] : study["method"];
  return method.text() == "paper";
}

JsonView StudyFolder::named_study() const {
  return study.exists() ? study["study"] : result["provenance"]["study"];
}

StudyFolder read_study_folder(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw std::invalid_argument(fmt::format(
        "{}: there is no such folder. Fix: name the folder that repose calibrate --out wrote.",
        folder.string()));
  }
  StudyFolder read{.folder = folder,
                   .study = JsonView::of_file(folder / "study.json"),
                   .result = JsonView::of_file(folder / "result.json"),
                   .runs = {},
                   .measured = {},
                   .pictures = {}};
  if (!read.study.exists() && !read.result.exists() &&
      !fs::is_directory(folder / "runs", ignored)) {
    throw std::invalid_argument(
        fmt::format("{}: there is no study in it (no study.json, result.json or runs). Fix: name "
                    "the folder that repose calibrate --out wrote.",
                    folder.string()));
  }
  if (read.result.exists() && !is_of(read.result, read.study)) {
    read.result = {};
    read.has_other_result = true;
  }
  read.runs = read.is_finished() ? runs_of_result(read.result) : runs_in(folder / "runs");
  for (const JsonView& observable : read.result["observables"].items()) {
    read.measured.push_back(measured_of(observable));
  }
  if (!read.is_finished()) read.measured = measured_of_record(folder);
  for (const JsonView& picture : read.study["pictures"].items()) {
    read.pictures.push_back({.file = picture["file"].text(),
                             .status = picture["status"].text(),
                             .angle_deg = picture["angle_deg"].number()});
  }
  return read;
}

}  // namespace repose::calibrate::report
