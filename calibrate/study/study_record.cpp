#include "calibrate/study/study_record.h"

#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/fingerprint.h"
#include "base/input_error.h"
#include "base/version.h"
#include "calibrate/bench/bench_readings.h"
#include "calibrate/experiment/run_store.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// File names need not be UTF-8, but JSON must be.
std::string json_text(const Json& json) {
  constexpr int kIndent = 2;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json pictures_json(const std::vector<PictureReading>& pictures) {
  Json json = Json::array();
  for (const PictureReading& picture : pictures) {
    json.push_back({{"file", picture.file.string()},
                    {"status", picture.status},
                    {"angle_deg", picture.angle_deg ? Json(*picture.angle_deg) : Json(nullptr)},
                    {"own_deg", picture.own_deg},
                    {"camera_deg", picture.camera_deg},
                    {"heap", picture.heap},
                    {"reason", picture.reason}});
  }
  return json;
}

std::vector<PictureReading> pictures_in(const Json& json) {
  std::vector<PictureReading> pictures;
  for (const Json& picture : json) {
    const Json& angle = picture.at("angle_deg");
    pictures.push_back({.file = picture.at("file").get<std::string>(),
                        .status = picture.at("status"),
                        .angle_deg = angle.is_null() ? std::nullopt : std::optional<double>(angle),
                        .reason = picture.at("reason"),
                        .own_deg = picture.value("own_deg", 0.),  // earlier versions had none
                        .camera_deg = picture.value("camera_deg", 0.),
                        .heap = picture.value("heap", "")});
  }
  return pictures;
}

Json sheets_json(const std::vector<SheetReadings>& sheets) {
  Json json = Json::array();
  for (const SheetReadings& sheet : sheets) {
    json.push_back({{"experiment", sheet.experiment},
                    {"file", sheet.file.string()},
                    {"rows", sheet.rows},
                    {"notes", sheet.notes},
                    {"in_air", sheet.in_air},
                    {"values", sheet.values}});
  }
  return json;
}

std::vector<SheetReadings> sheets_in(const Json& json) {
  std::vector<SheetReadings> sheets;
  for (const Json& sheet : json) {
    sheets.push_back({.experiment = sheet.at("experiment"),
                      .file = sheet.at("file").get<std::string>(),
                      .rows = sheet.at("rows"),
                      .notes = sheet.value("notes", std::vector<std::string>()),

                      .values = sheet.at("values"),
                      .in_air = sheet.value("in_air", true)});
  }
  return sheets;
}

Json films_json(const std::vector<FilmReading>& films) {
  Json json = Json::array();
  for (const FilmReading& film : films) {
    json.push_back({{"experiment", film.experiment},
                    {"file", film.file.string()},
                    {"status", film.status},
                    {"value", film.value ? Json(*film.value) : Json(nullptr)},
                    {"uncertainty", film.uncertainty},
                    {"length_error", film.length_error},
                    {"reason", film.reason}});
  }
  return json;
}

std::vector<FilmReading> films_in(const Json& json) {
  std::vector<FilmReading> films;
  for (const Json& film : json) {
    const Json& value = film.at("value");
    films.push_back({.experiment = film.at("experiment"),
                     .file = film.at("file").get<std::string>(),
                     .status = film.at("status"),
                     .value = value.is_null() ? std::nullopt : std::optional<double>(value),
                     .uncertainty = film.at("uncertainty"),
                     .reason = film.at("reason"),
                     .length_error = film.value("length_error", 0.)});
  }
  return films;
}

/// What its name does not specify.
Json limits_json(const Budget& budget) {
  return {{"minutes", *budget.minutes},
          {"core_s", budget.settings.budget_s},
          {"max_jobs", budget.settings.max_jobs},
          {"max_rounds", budget.settings.max_rounds},
          {"check_rounds", budget.check_rounds},
          {"round_repeats", budget.round_repeats},
          {"verification_repeats", budget.verification_repeats},
          {"family_sets", budget.family_sets}};
}

/// Without it, all full runs had the study's own grains.
double longest_run_s_in(const Json& budget) {
  return budget.value("longest_run_s", std::numeric_limits<double>::infinity());
}

std::optional<Budget> limits_in(const Json& json) {
  if (!json.contains("limits")) return std::nullopt;
  const Json& limits = json.at("limits");
  return Budget{.name = json.at("name"),
                .description = json.at("description"),
                .settings = {.budget_s = limits.at("core_s"),
                             .max_jobs = limits.at("max_jobs"),
                             .max_rounds = limits.at("max_rounds")},
                .check_rounds = limits.value("check_rounds", kMaxCheckRounds),
                .round_repeats = limits.at("round_repeats"),
                .verification_repeats = limits.at("verification_repeats"),
                .family_sets = limits.at("family_sets"),
                .longest_run_s = longest_run_s_in(json),
                .minutes = limits.at("minutes").get<double>()};
}

Json notes_json(const StudyNotes& notes) {
  const StudyIdentity& study = notes.study;
  Json budget = {{"name", study.budget}, {"description", study.budget_description}};
  if (notes.limits) budget["limits"] = limits_json(*notes.limits);
  if (study.is_mixed) budget["mixed"] = *study.is_mixed;
  if (study.is_mixed && std::isfinite(study.longest_run_s)) {
    budget["longest_run_s"] = study.longest_run_s;
  }
  return {{"program", study.program},
          {"study", {{"file", study.file}, {"hash", study.hash}, {"settings", study.settings}}},
          {"method", study.method},
          {"budget", budget},
          {"pictures", pictures_json(notes.measurement.pictures)},
          {"sheets", sheets_json(notes.measurement.sheets)},
          {"films", films_json(notes.measurement.films)},
          {"files", notes.fingerprints}};
}

std::optional<bool> mixed_in(const Json& budget) {
  return budget.contains("mixed") ? std::optional(budget.at("mixed").get<bool>()) : std::nullopt;
}

StudyNotes notes_in(const Json& json) {
  const Json& study = json.at("study");
  const Json& budget = json.at("budget");
  return {.study = {.program = json.at("program"),
                    .file = study.at("file"),
                    .hash = study.at("hash"),
                    .settings = study.at("settings"),
                    .method = json.at("method"),
                    .budget = budget.at("name"),
                    .budget_description = budget.at("description"),
                    .is_mixed = mixed_in(budget),
                    .longest_run_s = longest_run_s_in(budget)},
          // Earlier versions had no sheets, nor films.
          .measurement = {.sheets = sheets_in(json.value("sheets", Json::array())),
                          .pictures = pictures_in(json.at("pictures")),
                          .films = films_in(json.value("films", Json::array()))},
          .fingerprints = json.value("files", std::map<std::string, std::string>()),
          .limits = limits_in(budget)};
}

}  // namespace

bool is_same_study(const StudyIdentity& one, const StudyIdentity& other) {
  return one.hash == other.hash && one.settings == other.settings && one.method == other.method &&
         one.budget == other.budget &&
         one.is_mixed.value_or(false) == other.is_mixed.value_or(false);
}

StudyIdentity identity_of(const StudyRecord& record) {
  return {.program = base::kProgram,
          .file = record.study.file.filename().string(),
          .hash = record.study.hash,
          .settings = record.settings,
          .method = record.method,
          .budget = record.budget.name,
          .budget_description = record.budget.description,
          .is_mixed = record.method == "joint" && has_coarse_runs(record.study, record.grain.shape)
                          ? std::optional(!record.budget.is_full)
                          : std::nullopt,
          .longest_run_s = record.budget.longest_run_s};
}

namespace {

/// The file, which must be the one that study.json was written with; earlier versions do not say.
fs::path kept(const fs::path& folder, const char* name, const StudyNotes& notes) {
  const auto fingerprint = notes.fingerprints.find(name);
  if (fingerprint == notes.fingerprints.end()) return folder / name;
  if (base::fingerprint({base::read_whole_file(folder / name)}) != fingerprint->second) {
    throw base::InputError(
        {.where = (folder / name).string(),
         .value = fmt::format("does not belong to {} in the same folder: it was changed, or its "
                              "writing was interrupted",
                              kNotesFile),
         .fix = "the same repose calibrate again writes both anew; what was simulated is kept."});
  }
  return folder / name;
}

/// An existing identical file is not rewritten: a full disk does not stop a resumed study.
void keep(const fs::path& file, const std::string& text) {
  if (base::read_file_if_there(file) != text) base::write_whole_file(file, text);
}

}  // namespace

void write_study_files(const fs::path& folder, StudyNotes notes,
                       const std::map<std::string, std::string>& copies) {
  for (const auto& [name, text] : copies) {
    keep(folder / name, text);
    notes.fingerprints[name] = base::fingerprint({text});
  }
  keep(folder / kNotesFile, json_text(notes_json(notes)));
}

void write_study_record(const fs::path& folder, const StudyRecord& record) {
  write_study_files(folder,
                    {.study = identity_of(record),
                     .measurement = record.measurement,
                     .fingerprints = {},
                     .limits = record.budget.minutes ? std::optional(record.budget) : std::nullopt},
                    {{kStudyCopy, base::read_whole_file(record.study.file)},
                     {kClumpCopy, dem::clump_json(record.grain)}});
}

std::optional<StudyNotes> read_study_notes(const fs::path& folder) {
  const fs::path file = folder / kNotesFile;
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return std::nullopt;
  try {
    return notes_in(Json::parse(base::read_whole_file(file)));
  } catch (const nlohmann::json::exception& error) {
    base::refuse(file, fmt::format("damaged ({})", error.what()),
                 "the same repose calibrate again writes it anew; what was simulated is kept.");
  }
}

StudyRecord read_study_record(const fs::path& folder) {
  const std::optional<StudyNotes> notes = read_study_notes(folder);
  if (!notes) {
    base::refuse(folder, fmt::format("is not the folder of a study: it contains no {}", kNotesFile),
                 "name the output folder of repose calibrate.");
  }
  if (notes->study.budget.empty()) {
    base::refuse(folder,
                 "its runs are those of a table, made with another program: there is no particle, "
                 "contact model or experiment to simulate or to export",
                 "use its parameters in that program; repose report shows them.");
  }
  StudyRecord record;
  record.settings = notes->study.settings;
  record.method = notes->study.method;
  record.budget = notes->limits ? *notes->limits : budget_named(notes->study.budget);
  record.budget.is_full = !notes->study.is_mixed.value_or(false);
  record.budget.longest_run_s = notes->study.longest_run_s;
  record.measurement = notes->measurement;
  record.grain = dem::read_clump_file(kept(folder, kClumpCopy, *notes));
  record.study =
      as_measured(dem::read_study_copy(kept(folder, kStudyCopy, *notes), record.settings),
                  record.grain.shape, record.measurement);
  record.study.file = notes->study.file;
  record.study.hash = notes->study.hash;
  return record;
}

namespace {

bool has_notes(const fs::path& folder) {
  try {
    return read_study_notes(folder).has_value();
  } catch (const base::InputError&) {
    return false;
  }
}

bool is_copy(const fs::path& file, const fs::path& study) {
  return file.filename() == kStudyCopy &&
         base::read_file_if_there(file) == base::read_file_if_there(study);
}

}  // namespace

std::vector<std::string> foreign_files(const fs::path& folder, const fs::path& study) {
  if (is_run_store(folder) || has_notes(folder)) return {};
  std::vector<std::string> foreign;
  for (const char* name : {kStudyCopy, kClumpCopy, kNotesFile, kResultFile, kHeapFile}) {
    std::error_code ignored;
    const fs::path file = folder / name;
    if (fs::exists(fs::symlink_status(file, ignored)) && !is_copy(file, study)) {
      foreign.emplace_back(name);
    }
  }
  return foreign;
}

}  // namespace repose::calibrate
