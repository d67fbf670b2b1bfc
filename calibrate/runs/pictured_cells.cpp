#include "calibrate/runs/pictured_cells.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include "base/angle_definition.h"
#include "base/atomic_file.h"
#include "base/distributions.h"
#include "base/fingerprint.h"
#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/experiment/scan_angle.h"
#include "calibrate/particles/positions_angle.h"
#include "calibrate/runs/table_columns.h"
#include "vision/files/file_list.h"
#include "vision/files/heap_file.h"
#include "vision/film/film_angle.h"
#include "vision/scan/scan_file.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

/// A cell, and the measurement of the file that it names.
struct Cell {
  std::size_t row = 0;
  std::size_t column = 0;
  std::string reading;
  std::string name;  ///< as written
  std::string fingerprint;
  vision::ReposeAngle angle;
  std::string fault;
};

bool is_picture(const fs::path& file) {
  return vision::has_picture_ending(file) || vision::has_film_ending(file);
}

bool names_file(const std::string& cell, const fs::path& folder) {
  if (number_of(cell)) return false;
  const std::string small = in_small_letters(cell);
  if (is_nothing(small) || says_failed(small)) return false;
  return is_picture(cell) || vision::has_scan_ending(cell) || is_particle_file(folder / cell);
}

void measure(Cell& cell, const fs::path& folder, const PicturedReading& how) {
  const fs::path file = folder / cell.name;
  vision::PictureSettings told;
  told.measuring.definition = how.definition;
  try {
    cell.fingerprint = base::fingerprint({base::read_whole_file(file)});
    if (is_picture(file)) {
      cell.angle = vision::measure_heap_file(file, told).heap.angle;
    } else if (vision::has_scan_ending(file)) {
      cell.angle = measure_scan_file(file, told.measuring).angle;
    } else {
      const PositionsOptions options{.reading = {}, .placement = how.placement};
      cell.angle = measure_positions(file, options, told.measuring).angle;
    }
  } catch (const base::InputError& error) {
    // Names used in the study.
    static constexpr std::array<base::FieldName, 2> kKeys{
        {{"direction that is up", "key up"}, {"plate's height", "key plate_height"}}};
    cell.fault = base::text_of(error.faults(), kKeys);
  }
}

/// "line 7, runs/07.png: why".
std::string named(const Table& table, const Cell& cell, const std::string& why) {
  return fmt::format("line {}, {}: {}", table.rows[cell.row].line, cell.name, why);
}

std::vector<Cell> cells_in(const TableStudy& study, const fs::path& folder, const Table& table,
                           base::Faults& faults) {
  std::vector<Cell> cells;
  for (const std::string& reading : readings_of(study)) {
    const auto column = table.column(reading);
    if (!column) continue;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      const std::string& text = table.rows[row].cells[*column];
      if (!names_file(text, folder)) continue;
      if (!study.pictured.contains(reading)) {
        faults.add(
            {.where = fmt::format("{}:{}", table.name, table.rows[row].line),
             .subject = reading,
             .value = fmt::format("names the file {}, and is no angle", text),
             .rule = "what is measured in pictures and particles is a heap's angle",
             .fix = fmt::format("unit = \"deg\" for {} in the study, or a number.", reading)});
        return cells;
      }
      cells.push_back({.row = row,
                       .column = *column,
                       .reading = reading,
                       .name = text,
                       .fingerprint = {},
                       .angle = {},
                       .fault = {}});
    }
  }
  return cells;
}

/// Measurements of one reading.
class Reading {
 public:
  Reading(const Table& table, std::string name, std::string definition)
      : table_(table), name_(std::move(name)), definition_(std::move(definition)) {}

  /// The reading and its standard uncertainty; std::nullopt: there is no angle.
  std::optional<std::pair<double, double>> take(const Cell& cell) {
    if (!cell.angle.angle_rad || !cell.angle.uncertainty_rad) {
      refused_.push_back(named(table_, cell, cell.angle.reason));
      return std::nullopt;
    }
    if (cell.angle.status == vision::MeasureStatus::flagged) {
      std::vector<std::string> codes;
      for (const vision::Warning& warning : cell.angle.warnings) codes.push_back(warning.code);
      flagged_.push_back(named(table_, cell, fmt::format("{}", fmt::join(codes, ", "))));
    }
    const double sd_deg = to_degrees(*cell.angle.uncertainty_rad) / base::kNormal95;
    sds_.push_back(sd_deg);
    return std::pair(to_degrees(*cell.angle.angle_rad), sd_deg);
  }

  void add_notes(std::vector<std::string>& notes) const {
    const std::size_t all = sds_.size() + refused_.size();
    if (all == 0) return;
    std::string text =
        fmt::format("{}: {}: {} of {} pictures, scans and files of particles gave an angle, by {}",
                    table_.name, name_, sds_.size(), all, base::definition_meant(definition_));
    if (!sds_.empty()) {
      const auto [low, high] = std::ranges::minmax(sds_);
      text += fmt::format("; standard uncertainties {:.2g} to {:.2g} deg, which count", low, high);
    }
    notes.push_back(text + '.');
    if (definition_.empty()) {
      notes.push_back(fmt::format(
          "{}: the study does not say by which definition the bench's angle was measured: it must "
          "be the same. Fix: definition = \"{}\", or whichever it is.",
          name_, base::kUsualDefinition.name));
    }
    if (!refused_.empty()) {
      notes.push_back(fmt::format("{}: {}: refused, and without a reading: {}.", table_.name, name_,
                                  listed(refused_, "; ")));
    }
    if (!flagged_.empty()) {
      notes.push_back(fmt::format("{}: {}: flagged, and counted: {}. Look at these.", table_.name,
                                  name_, listed(flagged_, "; ")));
    }
  }

 private:
  const Table& table_;
  std::string name_;
  std::string definition_;
  std::vector<double> sds_;
  std::vector<std::string> refused_;
  std::vector<std::string> flagged_;
};

}  // namespace

PicturedCells measure_pictured_cells(const TableStudy& study, const fs::path& folder, Table& table,
                                     base::Faults& faults) {
  PicturedCells found;
  std::vector<Cell> cells = cells_in(study, folder, table, faults);
  if (!faults.empty()) return found;
  tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t k) {
    measure(cells[k], folder, study.pictured.at(cells[k].reading));
  });
  base::Faults unread(kMaxRowErrors);
  std::map<std::string, Reading> readings;
  for (const Cell& cell : cells) {
    const int line = table.rows[cell.row].line;
    if (!cell.fault.empty()) {
      unread.add({.where = fmt::format("{}:{}", table.name, line), .value = cell.fault});
      continue;
    }
    const std::string& definition = study.pictured.at(cell.reading).definition;
    Reading& reading =
        readings.try_emplace(cell.reading, table, cell.reading, definition).first->second;
    found.fingerprints.push_back(cell.fingerprint);
    const auto taken = reading.take(cell);
    std::string& text = table.rows[cell.row].cells[cell.column];
    text.clear();
    if (!taken) continue;
    // With more than three decimals, a point is not mistaken for a thousands separator.
    text = fmt::format("{:.6f}", taken->first);
    if (table.has_decimal_comma) std::ranges::replace(text, '.', ',');
    found.sds[line][cell.reading] = taken->second;
  }
  faults.add_all(unread.all());
  for (const auto& [name, reading] : readings) reading.add_notes(found.notes);
  return found;
}

}  // namespace repose::calibrate
