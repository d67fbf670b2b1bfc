#include "studio/study_folder.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/fingerprint.h"
#include "base/input_error.h"
#include "base/text.h"
#include "calibrate/bench/bench_readings.h"
#include "calibrate/run/run_study.h"
#include "calibrate/runs/table_study.h"
#include "calibrate/statistics/bench/sheet.h"
#include "calibrate/statistics/table/table.h"
#include "calibrate/study/study_problem.h"

namespace repose::studio {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kLargestStudy_bytes = std::uintmax_t{1} << 20;

/// A study has one of these sections; camera files and hint files, with the same ending, have none.
bool is_study(const fs::path& file) {
  std::error_code ignored;
  const std::string name = file.filename().string();
  if (file.extension() != ".toml" || name.front() == '.' || name.ends_with(".repose.toml") ||
      !fs::is_regular_file(fs::symlink_status(file, ignored)) ||
      fs::file_size(file, ignored) > kLargestStudy_bytes) {
    return false;
  }
  std::string text;
  try {
    text = '\n' + base::read_whole_file(file, kLargestStudy_bytes);
  } catch (const base::InputError&) {
    return false;  // not readable by us
  }
  return std::ranges::any_of(
      std::array{"\n[particle", "\n[experiment", "\n[study", "\n[parameter"},
      [&](const char* section) { return text.find(section) != std::string::npos; });
}

std::vector<fs::path> studies_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_study(entry->path())) files.push_back(entry->path());
  }
  std::ranges::sort(files);
  return files;
}

/// Texts of errors, with the names of files in the folder relative to it.
Json texts_of(const std::vector<base::Fault>& faults, const fs::path& folder) {
  const std::string prefix = (folder / "").string();
  Json texts = Json::array();
  for (const base::Fault& fault : faults) {
    std::string text = base::with_names(fault.text());
    for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) {
      text.erase(at, prefix.size());
    }
    texts.push_back(text);
  }
  return texts;
}

/// What can be determined about a study without simulating.
struct Looked {
  std::optional<dem::Study> study;
  std::vector<base::Fault> faults;
  std::vector<std::string> notes;
};

Looked look_at(const fs::path& file, const std::vector<std::string>& settings = {}) {
  Looked looked;
  try {
    looked.study = dem::read_study(file, settings);
  } catch (const base::InputError& error) {
    looked.faults = error.faults();
    return looked;
  }
  try {
    for (const auto& sheet : calibrate::read_sheets(*looked.study, calibrate::NoRows::refused)) {
      looked.notes.insert(looked.notes.end(), sheet.notes.begin(), sheet.notes.end());
    }
  } catch (const base::InputError& error) {
    looked.faults = error.faults();
  }
  return looked;
}

/// For a study of the user's own runs.
Json table_study_json(const fs::path& file) {
  Json json{{"study", file.filename().string()}, {"title", file.stem().string()}};
  json["is_table"] = true;
  json["faults"] = Json::array();
  return json;
}

Json head_json(const fs::path& file, const Looked& looked) {
  std::string title = looked.study ? looked.study->heading.title : std::string();
  if (title.empty()) title = file.stem().string();
  return {{"study", file.filename().string()},
          {"title", title},
          {"is_table", false},
          {"faults", texts_of(looked.faults, file.parent_path())}};
}

/// The keys of a protocol, from its experiment's entry.
Json keys_json(const dem::ExperimentEntry& entry, dem::Protocol protocol) {
  Json keys = Json::array();
  for (const dem::ProtocolKey& key : entry.keys(protocol)) {
    const auto value = value_of(key);
    const bool is_optional = !key.absence.empty();
    keys.push_back({{"key", key.name},
                    {"value", value ? fmt::format("{:g}", *value) : std::string()},
                    {"example", key.example},
                    {"rule", key.range.rule()},
                    {"absence", is_optional ? Json(key.absence) : Json(nullptr)}});
  }
  return keys;
}

/// How an experiment was measured.
std::string measured_text(const dem::Measured& measured) {
  if (measured.sheet) return "sheet";
  if (!measured.pictures.empty()) return "pictures";
  if (!measured.videos.empty()) return "films";
  if (!measured.scans.empty()) return "scans";
  if (measured.mean || !measured.values.empty()) return "values";
  return "nothing";
}

/// `usual` is the study's value for the bench, which every row repeats.
Json columns_json(const dem::ExperimentEntry& entry, const dem::Protocol& protocol,
                  const std::vector<std::string>& present) {
  const calibrate::BenchTest test = calibrate::bench_test_named(entry.sheet.test);
  Json columns = Json::array();
  const auto add = [&](const std::string& name, const std::string& what, const char* standing) {
    Json usual = nullptr;
    for (const auto& [column, key] : entry.sheet.protocol) {
      if (column != name) continue;
      usual = fmt::format("{:g}", calibrate::protocol_value(entry, protocol, key));
    }
    columns.push_back({{"name", name}, {"what", what}, {"standing", standing}, {"usual", usual}});
  };
  std::vector<std::string> known;
  for (const auto& column : columns_of(test)) {
    known.push_back(column.name);
    add(column.name, column.what, "needed");
  }
  for (const auto& column : optional_columns_of(test)) {
    known.push_back(column.name);
    if (std::ranges::find(present, column.name) != present.end()) {
      add(column.name, column.what, "optional");
    }
  }
  for (const std::string& name : present) {
    if (std::ranges::find(known, name) != known.end()) continue;
    const bool is_sample = name == calibrate::kSampleColumn;
    add(name, is_sample ? "name of the grain" : "not a reading of this test",
        is_sample ? "optional" : "other");
  }
  return columns;
}

/// The sheet's cells in the order of its columns: those that are needed, then any others.
Json cells_json(const calibrate::Table& table, const Json& columns) {
  Json rows = Json::array();
  for (const calibrate::TableRow& row : table.rows) {
    Json& cells = rows.emplace_back(Json::array());
    for (const Json& column : columns) {
      const auto place = table.column(column.at("name").get<std::string>());
      cells.push_back(place ? row.cells[*place] : "");
    }
  }
  return rows;
}

/// The table filled in on the page, with the line numbers that the file will have.
calibrate::Table table_of(const std::string& name, const Json& cells) {
  constexpr std::size_t kMostRows = 10'000, kMostColumns = 100, kLongestCell = 1000;
  calibrate::Table table{.name = name, .columns = {}, .rows = {}};
  try {
    table.columns = cells.at("columns").get<std::vector<std::string>>();
    for (const Json& row : cells.at("rows")) {
      table.rows.push_back({.line = static_cast<int>(table.rows.size()) + 2,
                            .cells = row.get<std::vector<std::string>>()});
    }
  } catch (const Json::exception&) {
    throw base::InputError({.value = "what was sent is no table of texts"});
  }
  bool fits = !table.columns.empty() && table.columns.size() <= kMostColumns &&
              table.rows.size() <= kMostRows;
  for (const calibrate::TableRow& row : table.rows) {
    fits &= row.cells.size() == table.columns.size();
    for (const std::string& cell : row.cells) {
      fits &= cell.size() <= kLongestCell && cell.find_first_of("\r\n") == std::string::npos;
    }
  }
  if (!fits) {
    throw base::InputError(
        {.where = name,
         .value = "what was sent is no table of as many cells in each row as it has columns",
         .rule = fmt::format("at most {} rows, and no line breaks in cells", kMostRows)});
  }
  return table;
}

/// The row of an error: "drops.csv:4" is the fourth line, where the header is the first.
std::optional<std::size_t> row_of(const base::Fault& fault, std::size_t rows) {
  const std::size_t colon = fault.where.rfind(':');
  if (colon == std::string::npos) return std::nullopt;
  int line = 0;
  const char* const end = fault.where.data() + fault.where.size();
  const auto [stopped_at, error] = std::from_chars(fault.where.data() + colon + 1, end, line);
  if (error != std::errc{} || stopped_at != end || line < 2) return std::nullopt;
  const auto row = static_cast<std::size_t>(line - 2);
  return row < rows ? std::optional(row) : std::nullopt;
}

/// The column that an error concerns: the one that it names first.
std::optional<std::size_t> column_of(const base::Fault& fault,
                                     const std::vector<std::string>& columns) {
  const std::string text = fault.subject + ' ' + fault.value;
  std::optional<std::size_t> found;
  std::size_t first = std::string::npos;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::size_t at = columns[k].empty() ? std::string::npos : text.find(columns[k]);
    if (at >= first) continue;
    first = at;
    found = k;
  }
  return found;
}

}  // namespace

Json sought_json(const dem::Study& study) {
  Json sought = Json::array();
  const auto add_set = [&](const std::string& pair, const dem::CoefficientSet& set) {
    const auto add = [&](const char* name, const dem::Coefficient& coefficient) {
      if (!coefficient.is_free()) return;
      sought.push_back({{"name", fmt::format("contact.{}.{}", pair, name)},
                        {"value", coefficient.value ? Json(*coefficient.value) : Json(nullptr)},
                        {"min", coefficient.min},
                        {"max", coefficient.max}});
    };
    add("restitution", set.restitution);
    add("sliding_friction", set.sliding_friction);
    add("rolling_friction", set.rolling_friction);
    add("restitution_exponent", set.restitution_exponent);
  };
  add_set("particle_wall", study.particle_wall);
  for (const auto& [part, set] : study.particle_parts) add_set("particle_" + name_of(part), set);
  add_set("particle_particle", study.particle_particle);
  return sought;
}

bool is_within(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const fs::path there = fs::weakly_canonical(fs::absolute(file), error);
  if (error) return false;
  const fs::path inside = fs::canonical(folder, error);
  if (error) return false;
  const auto [end, ignored] = std::ranges::mismatch(inside, there);
  return end == inside.end();
}

struct StudyFolder::SheetOf {
  const dem::ExperimentEntry* entry = nullptr;
  dem::StudyExperiment described;
  fs::path file;

  std::string name() const { return file.filename().string(); }
  std::string text() const { return base::read_file_if_there(file).value_or(""); }
};

fs::path StudyFolder::path_of(const std::string& name) const {
  for (const fs::path& file : studies_in(folder_)) {
    if (file.filename().string() == name) return file;
  }
  throw base::InputError({.where = base::printable(name),
                          .value = "there is no such study in the folder",
                          .fix = "load the page again."});
}

fs::path StudyFolder::calibration_of(const std::string& name) const {
  return folder_ / calibrate::default_folder(path_of(name));
}

Json StudyFolder::list() const {
  Json studies = Json::array();
  for (const fs::path& file : studies_in(folder_)) {
    studies.push_back(calibrate::is_table_study(file) ? table_study_json(file)
                                                      : head_json(file, look_at(file)));
  }
  return {{"studies", studies}};
}

Json StudyFolder::study(const std::string& name) const {
  const fs::path file = path_of(name);
  if (calibrate::is_table_study(file)) return table_study_json(file);
  const Looked looked = look_at(file);
  Json json = head_json(file, looked);
  if (!looked.study) return json;
  json["hash"] = looked.study->hash;
  json["version"] = base::fingerprint({base::read_whole_file(file)});
  json["notes"] = looked.notes;
  json["sought"] = sought_json(*looked.study);
  json["experiments"] = Json::array();
  for (const auto& [experiment, described] : looked.study->experiments) {
    const dem::ExperimentEntry& entry = *experiment;
    Json one{{"experiment", entry.name},
             {"description", entry.description},
             {"value_name", entry.value_name},
             {"unit", entry.unit},
             {"keys", keys_json(entry, described.protocol)},
             {"measured", measured_text(described.measured)},
             {"sheet", nullptr}};
    const auto& sheet = described.measured.sheet;
    if (sheet && is_within(*sheet, folder_)) {
      const std::string text = base::read_whole_file(*sheet);
      one["sheet"] = {{"name", sheet->lexically_relative(folder_).generic_string()},
                      {"version", base::fingerprint({text})},
                      {"fault", nullptr}};
      calibrate::Table table{.name = sheet->filename().string(), .columns = {}, .rows = {}};
      try {
        table = calibrate::parse_table(table.name, text, calibrate::NoRows::allowed);
      } catch (const base::InputError& error) {
        one["sheet"]["fault"] = base::with_names(error.what());
      }
      const Json columns = columns_json(entry, described.protocol, table.columns);
      one["sheet"]["columns"] = columns;
      one["sheet"]["rows"] = cells_json(table, columns);
    }
    json["experiments"].push_back(one);
  }
  return json;
}

StudyFolder::SheetOf StudyFolder::sheet_of(const std::string& name,
                                           const std::string& experiment) const {
  const dem::Study study = dem::read_study(path_of(name));
  for (const auto& [one, described] : study.experiments) {
    if (one->name != experiment || !described.measured.sheet) continue;
    const fs::path& file = *described.measured.sheet;
    if (is_within(file, folder_)) return {.entry = one, .described = described, .file = file};
  }
  throw base::InputError(
      {.where = base::printable(name),
       .value = fmt::format("names no sheet in this folder for {}", base::printable(experiment)),
       .fix = "load the page again."});
}

Json StudyFolder::checked_sheet(const std::string& name, const std::string& experiment,
                                const Json& cells) const {
  const SheetOf sheet = sheet_of(name, experiment);
  const calibrate::Table table = table_of(sheet.name(), cells);
  Json faults = Json::array(), notes = Json::array();
  int readings = 0;
  try {
    // Exactly as it will be read from the file.
    const auto given = calibrate::readings_of_table(
        *sheet.entry, sheet.described, sheet.name(),
        calibrate::parse_table(table.name, csv_text(table), calibrate::NoRows::allowed),
        calibrate::NoRows::allowed);
    readings = given.rows;
    notes = given.notes;
  } catch (const base::InputError& error) {
    for (const base::Fault& fault : error.faults()) {
      const auto row = row_of(fault, table.rows.size());
      const auto column = row ? column_of(fault, table.columns) : std::nullopt;
      faults.push_back({{"row", row ? Json(*row) : Json(nullptr)},
                        {"column", column ? Json(*column) : Json(nullptr)},
                        {"text", base::with_names(fault.text())}});
    }
  }
  return {{"faults", faults}, {"notes", notes}, {"readings", readings}};
}

void require_version(const Json& sent, const std::string& text, const std::string& name) {
  const auto version = sent.find("version");
  if (version != sent.end() && *version == base::fingerprint({text})) return;
  throw ChangedMeanwhile({.where = name,
                          .value = "was changed meanwhile, on another page or by hand",
                          .fix = "load it again, and make the change once more."});
}

namespace {

/// The columns of a table that a test reads, in the table's order.
std::vector<std::string> columns_read(const calibrate::BenchTest& test,
                                      const calibrate::Table& table) {
  std::vector<std::string> read{std::string(calibrate::kSampleColumn)};
  for (const auto& column : columns_of(test)) read.push_back(column.name);
  for (const auto& column : optional_columns_of(test)) read.push_back(column.name);
  std::vector<std::string> columns;
  for (const std::string& column : table.columns) {
    if (std::ranges::find(read, column) != read.end()) columns.push_back(column);
  }
  return columns;
}

/// The row's cell in that column; empty if there is no such column.
std::string cell_of(const calibrate::Table& table, const calibrate::TableRow& row,
                    std::string_view column) {
  const auto place = table.column(column);
  return place ? row.cells[*place] : std::string();
}

/// In columns that a film adds, existing rows get the values of typed readings: heights read in
/// air, settings exact.
void add_column(calibrate::Table& table, const std::string& name) {
  const bool is_name = name == calibrate::kSampleColumn;
  if (table.columns.size() == 1) table.delimiter = ',';
  table.columns.push_back(name);
  for (calibrate::TableRow& row : table.rows) {
    row.cells.emplace_back(is_name ? "" : name == calibrate::kInAirColumn ? "1" : "0");
  }
}

}  // namespace

Json StudyFolder::add_readings(const std::string& name, const std::string& experiment,
                               const std::string& csv) {
  const SheetOf sheet = sheet_of(name, experiment);
  const auto given = calibrate::parse_table("film", csv, calibrate::NoRows::refused);
  const std::lock_guard lock(saving_);
  auto table = calibrate::parse_table(sheet.name(), sheet.text(), calibrate::NoRows::allowed);
  const std::string sample(calibrate::kSampleColumn);
  std::erase_if(table.rows, [&](const calibrate::TableRow& row) {
    const std::string own = cell_of(table, row, sample);
    return !own.empty() && std::ranges::any_of(given.rows, [&](const calibrate::TableRow& other) {
      return cell_of(given, other, sample) == own;
    });
  });
  const auto columns = columns_read(calibrate::bench_test_named(sheet.entry->sheet.test), given);
  for (const std::string& column : columns) {
    if (!table.column(column)) add_column(table, column);
  }
  for (const calibrate::TableRow& row : given.rows) {
    std::vector<std::string> cells;
    for (const std::string& column : table.columns) {
      const bool is_read = std::ranges::find(columns, column) != columns.end();
      cells.push_back(is_read ? cell_of(given, row, column) : "");
    }
    table.rows.push_back({.line = 0, .cells = std::move(cells)});
  }
  const std::string text = csv_text(table);
  const auto checked = calibrate::readings_of_table(
      *sheet.entry, sheet.described, sheet.name(),
      calibrate::parse_table(sheet.name(), text, calibrate::NoRows::allowed),
      calibrate::NoRows::allowed);
  base::write_whole_file(sheet.file, text);
  return {{"sheet", sheet.file.lexically_relative(folder_).generic_string()},
          {"rows", given.rows.size()},
          {"notes", checked.notes}};
}

Json StudyFolder::save_sheet(const std::string& name, const std::string& experiment,
                             const Json& cells) {
  const SheetOf sheet = sheet_of(name, experiment);
  Json answer = checked_sheet(name, experiment, cells);
  const calibrate::Table table = table_of(sheet.name(), cells);
  const std::lock_guard lock(saving_);
  require_version(cells, sheet.text(), sheet.name());
  const std::string text = csv_text(table);
  base::write_whole_file(sheet.file, text);
  answer["version"] = base::fingerprint({text});
  return answer;
}

}  // namespace repose::studio
