#include <algorithm>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/folder_lock.h"
#include "base/input_error.h"
#include "base/text.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/export/export.h"
#include "calibrate/report/study_report.h"
#include "calibrate/result/result.h"
#include "calibrate/study/study_record.h"
#include "studio/calibrations.h"

// The state of a calibration, read from its folder.

namespace repose::studio {

namespace fs = std::filesystem;

namespace {

constexpr const char* kReportFile = "report.html";

/// A file's content; null if it does not exist or is not JSON.
Json json_in_file(const fs::path& file) {
  try {
    const auto text = base::read_file_if_there(file);
    Json json = text ? Json::parse(*text, nullptr, false) : Json(nullptr);
    return json.is_discarded() ? Json(nullptr) : json;
  } catch (const base::InputError&) {
    return nullptr;
  }
}

int runs_in(const fs::path& folder) {
  int runs = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder / "runs", error), end; !error && entry != end;
       entry.increment(error)) {
    runs += entry->path().extension() == ".json" ? 1 : 0;
  }
  return runs;
}

/// The parts of result.json that the page shows; the report has all of it.
Json result_json(const Json& result) {
  Json shown{{"verdict", result.value("verdict", Json(nullptr))},
             {"parameters", Json::array()},
             {"observables", Json::array()}};
  for (const Json& parameter : result.value("parameters", Json::array())) {
    Json& one = shown["parameters"].emplace_back(Json::object());
    for (const char* key : {"name", "value", "interval", "verdict", "bounds", "advice"}) {
      one[key] = parameter.value(key, Json(nullptr));
    }
  }
  for (const Json& observable : result.value("observables", Json::array())) {
    Json& one = shown["observables"].emplace_back(Json::object());
    for (const char* key : {"name", "unit", "measured", "measured_uncertainty", "simulated",
                            "simulated_uncertainty"}) {
      one[key] = observable.value(key, Json(nullptr));
    }
  }
  return shown;
}

/// Adds the files in a folder that are meant for the user, with their path; links are ignored.
void add_files(const fs::path& folder, const fs::path& within, const char* ending, Json& files) {
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::directory_iterator entry(folder / within, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    const fs::path& file = entry->path();
    const bool is_meant = *ending == 0 || file.extension() == ending;
    if (is_meant && fs::is_regular_file(fs::symlink_status(file, ignored))) found.push_back(file);
  }
  std::ranges::sort(found);
  for (const fs::path& file : found) {
    std::error_code ignored;
    files.push_back({{"name", (within / file.filename()).generic_string()},
                     {"bytes", fs::file_size(file, ignored)}});
  }
}

Json files_in(const fs::path& folder) {
  Json files = Json::array();
  for (const char* name : {calibrate::kResultFile, kReportFile, kPlanFile}) {
    std::error_code ignored;
    const fs::path file = folder / name;
    if (!fs::is_regular_file(fs::symlink_status(file, ignored))) continue;
    files.push_back({{"name", name}, {"bytes", fs::file_size(file, ignored)}});
  }
  add_files(folder, "tables", ".csv", files);
  for (const calibrate::ExportTarget target : calibrate::export_targets()) {
    add_files(folder, fs::path("export") / name_of(target), "", files);
  }
  return files;
}

/// Null if there is none or only a provisional one, which the report shows.
Json final_result_in(const fs::path& folder) {
  Json result = json_in_file(folder / calibrate::kResultFile);
  return result.is_object() && result.contains("provisional") ? Json(nullptr) : result;
}

/// Whether an existing result belongs to the study in its current form.
bool is_current(const StudyFolder& studies, const std::string& study, const fs::path& folder) {
  const auto text = base::read_file_if_there(folder / calibrate::kResultFile);
  const auto identity = text ? calibrate::study_in_result(*text) : std::nullopt;
  if (!identity) return false;
  const Json now = studies.study(study);
  return now.contains("hash") && now.at("hash") == identity->hash;
}

}  // namespace

Json Calibrations::state(const std::string& study) const {
  const fs::path folder = studies_.calibration_of(study);
  Json own = Json::array();
  bool is_ours = false;
  const Json all = tasks();
  for (const Json& task : all.at("tasks")) {
    if (task.at("study") != study) continue;
    is_ours |= task.at("state") == "running" || task.at("state") == "stopping";
    own.push_back(task);
  }
  const bool is_inside = is_within(folder, studies_.folder());
  const bool is_locked = base::is_locked_by_another(calibrate::lock_file_in(folder));
  const Json result = is_inside ? final_result_in(folder) : Json(nullptr);
  const int runs = is_inside ? runs_in(folder) : 0;
  // A plan leaves runs there too; a calibration first records which study they belong to.
  std::error_code ignored;
  const bool is_begun = is_inside && fs::exists(folder / calibrate::kNotesFile, ignored);
  std::string state = is_begun ? "unfinished" : "none";
  if (result.is_object()) state = is_current(studies_, study, folder) ? "finished" : "changed";
  if (is_locked) state = "running";
  Json json{{"study", study},
            {"folder", folder.filename().string()},
            {"state", state},
            {"is_elsewhere", is_locked && !is_ours},
            {"runs", runs},
            {"progress", is_inside ? json_in_file(folder / kProgressFile) : Json(nullptr)},
            {"result", result.is_object() ? result_json(result) : Json(nullptr)},
            {"estimate", nullptr},
            {"plan", is_inside ? json_in_file(folder / kPlanFile) : Json(nullptr)},
            {"files", is_inside ? files_in(folder) : Json::array()},
            {"targets", Json::array()},
            {"tasks", own}};
  for (const calibrate::ExportTarget target : calibrate::export_targets()) {
    json["targets"].push_back({{"name", name_of(target)}, {"summary", summary_of(target)}});
  }
  const std::lock_guard lock(mutex_);
  const auto estimate = estimates_.find(study);
  if (estimate != estimates_.end()) json["estimate"] = estimate->second;
  return json;
}

std::string Calibrations::report(const std::string& study) {
  const fs::path folder = studies_.calibration_of(study);
  if (!is_within(folder, studies_.folder())) {
    base::refuse(folder, "leads out of the folder", "move it away.");
  }
  const std::lock_guard lock(reporting_);
  std::error_code ignored, none;
  const fs::path page = folder / kReportFile, result = folder / calibrate::kResultFile;
  if (!fs::exists(result, ignored)) return calibrate::report::study_report(folder).html;
  const auto made = fs::last_write_time(page, none);
  if (none || made < fs::last_write_time(result, ignored)) calibrate::report::write_report(folder);
  return base::read_whole_file(page);
}

std::string Calibrations::file(const std::string& study, const std::string& name) const {
  const fs::path folder = studies_.calibration_of(study);
  if (is_within(folder, studies_.folder())) {
    for (const Json& file : files_in(folder)) {
      if (file.at("name") != name || !is_within(folder / name, folder)) continue;
      return base::read_whole_file(folder / name);
    }
  }
  throw base::InputError({.where = base::printable(name),
                          .value = "there is no such file in the calibration's folder",
                          .fix = "load the page again."});
}

}  // namespace repose::studio
