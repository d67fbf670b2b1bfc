#include "calibrate/bench/bench_readings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/air_drag.h"
#include "base/distributions.h"
#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/statistics/bench/sheet.h"
#include "calibrate/statistics/summary.h"
#include "dem/experiment/experiment_table.h"

namespace repose::calibrate {

double protocol_value(const dem::ExperimentEntry& entry, dem::Protocol protocol,
                      std::string_view key) {
  const std::vector<dem::ProtocolKey> keys = entry.keys(protocol);
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const auto& one) { return one.name == key; });
  return dem::value_of(*found).value();
}

namespace {

/// Corrects one experiment's heights, in mm, for air drag.
class Evacuation {
 public:
  Evacuation(std::string experiment, const base::FallingGrain& grain, double fall_m)
      : experiment_(std::move(experiment)), grain_(grain), fall_m_(fall_m) {}

  /// Heights below 0, of grains that topple, are not flights.
  double rise_mm(double read_mm) const {
    if (read_mm <= 0) return read_mm;
    return kMmPerM * base::rise_without_air_m(grain_, fall_m_, read_mm * kMPerMm);
  }

  void check(double read_mm) {
    errors_.require(
        rise_mm(read_mm) <= kMmPerM * fall_m_,
        {.value = fmt::format("[experiment.{}]: a rebound of {:g} mm after a fall of {:g} mm",
                              experiment_, read_mm, kMmPerM * fall_m_),
         .rule = fmt::format("no higher than the grain, of {:.3g} mm and {:g} kg/m3, fell, less "
                             "what the drag of the air takes",
                             kMmPerM * grain_.diameter_m, grain_.density_kg_m3),
         .fix = "check the grain's size and density; in_air = false beside readings that are free "
                "of drag already."});
  }

  /// Derivative of the rise with respect to the reading.
  double slope(double read_mm) const {
    constexpr double kStep = 1e-3;
    if (read_mm <= 0) return 1;
    return (rise_mm(read_mm) - rise_mm((1 - kStep) * read_mm)) / (kStep * read_mm);
  }

  dem::Systematic systematic(double read_mm) const {
    const double rise = rise_mm(read_mm);
    const double sd = base::drag_uncertainty(grain_) * std::abs(rise - read_mm);
    return {.name = kAirPart,
            .sd = sd,
            .note = fmt::format(
                "the drag of the air is taken out: {:.4g} mm read in air count as {:.4g} mm, ± "
                "{:.2g} mm (standard uncertainty), as of a grain of {:.3g} mm, {:g} kg/m3 and "
                "sphericity {:.2f}. Where readings are free of drag already, say in_air = false",
                read_mm, rise, sd, kMmPerM * grain_.diameter_m, grain_.density_kg_m3,
                grain_.sphericity)};
  }

  /// Existing uncertainties of the readings scale with the slope, as their scatter does.
  void add_to(std::vector<dem::Systematic>& parts, double read_mm) const {
    for (dem::Systematic& part : parts) part.sd *= slope(read_mm);
    parts.push_back(systematic(read_mm));
  }

  void take_out(dem::Measured& measured) {
    if (measured.mean) {
      check(*measured.mean);
      add_to(measured.systematic, *measured.mean);
      if (measured.sd) *measured.sd *= slope(*measured.mean);
      *measured.mean = rise_mm(*measured.mean);
    } else if (!measured.values.empty()) {
      add_to(measured.systematic, summarise(measured.values).mean);
      for (double& value : measured.values) {
        check(value);
        value = rise_mm(value);
      }
    }
    for (dem::MeasuredReading& reading : measured.also) {
      check(reading.mean);
      add_to(reading.systematic, reading.mean);
      if (reading.sd) *reading.sd *= slope(reading.mean);
      reading.mean = rise_mm(reading.mean);
    }
  }

  void throw_if_impossible() const { errors_.throw_if_any(); }

 private:
  std::string experiment_;
  base::FallingGrain grain_;
  double fall_m_;
  base::Faults errors_;
};

}  // namespace

base::FallingGrain falling_grain(const dem::ClumpShape& grain, double density_kg_m3) {
  constexpr double kFlattest = 1e-3;  // of the largest: thinner grains have no sphericity
  const dem::Vector& k2 = grain.gyration_m2;
  std::array<double, 3> axes{};
  for (int i = 0; i < 3; ++i) axes[static_cast<std::size_t>(i)] = 2.5 * (k2.sum() - 2 * k2[i]);
  const double longest2 = *std::max_element(axes.begin(), axes.end());
  for (double& axis : axes) axis = std::sqrt(std::max(axis, kFlattest * kFlattest * longest2));
  constexpr double kPower = 1.6075;
  const auto part = [&](std::size_t i, std::size_t j) {
    return std::pow(axes[i] * axes[j], kPower) / 3;
  };
  const double surface = std::pow(part(0, 1) + part(0, 2) + part(1, 2), 1 / kPower);
  const double sphere = std::pow(axes[0] * axes[1] * axes[2], 2. / 3);
  return {.diameter_m = std::cbrt(6 / std::numbers::pi * grain.volume_m3),
          .density_kg_m3 = density_kg_m3,
          .sphericity = std::min(1., sphere / surface)};
}

dem::Study without_air(dem::Study study, const dem::ClumpShape& grain) {
  const base::FallingGrain falling = falling_grain(grain, study.model.grain_material.density_kg_m3);
  for (auto& [experiment, described] : study.experiments) {
    if (!experiment->is_in_air || !described.measured.in_air) continue;
    const double height_m = experiment->fall_m(grain, described.protocol);
    Evacuation evacuation(dem::name_of(experiment), falling, height_m);
    evacuation.take_out(described.measured);
    evacuation.throw_if_impossible();
  }
  return study;
}

namespace {

/// How a film's experiment differs from the study's; empty: it does not.
std::string other_setting(const dem::ExperimentEntry& entry, const dem::Protocol& protocol,
                          const std::map<std::string, FilmNumber>& row) {
  std::vector<dem::FilmedSetting> settings = entry.filmed_settings;
  for (const auto& [column, key] : entry.sheet.protocol) {
    settings.push_back({column, key, kSameSetting});
  }
  for (const auto& [column, key, tolerance] : settings) {
    const FilmNumber& seen = row.at(std::string(column));
    const double meant = protocol_value(entry, protocol, key);
    if (std::abs(seen.value - meant) <= tolerance * meant + seen.uncertainty) continue;
    return fmt::format(
        "{0} = {1:.4g} ± {2:.2g} in it, and the study has {3} = {4:g} in [experiment.{5}]. Rule: "
        "the same within {6:g} % and the film's interval. Fix: write {3} = {1:.4g} there if the "
        "bench was set so. Of films that show it wrongly, as those in slow motion, give a sheet of "
        "readings instead: repose track {5} {7}--csv {5}.csv.",
        column, seen.value, seen.uncertainty, key, meant, entry.name, 100 * tolerance,
        entry.sheet.protocol.empty() ? "" : "--scale ... ");
  }
  return {};
}

void share_length_error(double error, dem::StudyExperiment& described) {
  constexpr double kWorthSaying = 1e-9;
  if (std::abs(error) < kWorthSaying) return;
  const dem::ExperimentEntry& entry = dem::entry_of(described.protocol);
  const double sd = std::abs(error * summarise(described.measured.values).mean);
  described.measured.systematic.push_back(
      {.name = "film",
       .sd = sd,
       .note = fmt::format(
           "its films show a length that the study states {:+.2g} % off: by as much all that is "
           "read off them may be off, ± {:.2g} {} (standard uncertainty), which more films do not "
           "lower. Fix: state what was set, or check the frame rate",
           100 * error, sd, entry.unit)});
}

}  // namespace

void read_row(const dem::ExperimentEntry& entry, const dem::Protocol& protocol,
              const std::map<std::string, FilmNumber>& row, FilmReading& film) {
  const std::string other = other_setting(entry, protocol, row);
  if (!other.empty()) {
    film.status = "refused";
    film.reason = other;
    return;
  }
  const FilmNumber& reading = row.at(std::string(entry.sheet.value));
  film.value = reading.value;
  film.uncertainty = reading.uncertainty;
  for (const auto& [column, key] : entry.sheet.protocol) {
    if (!column.ends_with("_mm")) continue;
    film.length_error =
        row.at(std::string(column)).value / protocol_value(entry, protocol, key) - 1;
  }
}

dem::Study with_films(dem::Study study, const std::vector<FilmReading>& films) {
  for (auto& [experiment, described] : study.experiments) {
    const std::string name = dem::name_of(experiment);
    dem::Measured& measured = described.measured;
    double squares = 0;
    double length_errors = 0;
    for (const FilmReading& film : films) {
      if (film.experiment != name || !film.value) continue;
      measured.values.push_back(*film.value);
      squares += film.uncertainty * film.uncertainty;
      length_errors += film.length_error;
    }
    if (measured.videos.empty() || measured.values.empty()) continue;
    const auto count = static_cast<double>(measured.values.size());
    measured.value_uncertainty = std::sqrt(squares / count) / base::kNormal95;
    share_length_error(length_errors / count, described);
  }
  return study;
}

PictureSet set_of(const std::vector<PictureReading>& pictures) {
  std::vector<SetPicture> all;
  for (const PictureReading& picture : pictures) {
    all.push_back({.status = picture_status_named(picture.status),
                   .angle_deg = picture.angle_deg,
                   .own_deg = picture.own_deg,
                   .camera_deg = picture.camera_deg,
                   .heap = picture.heap});
  }
  return set_of_pictures(all);
}

dem::Study with_pictures(dem::Study study, const std::vector<PictureReading>& pictures) {
  const auto heap = study.experiments.find(&dem::pictured_experiment());
  if (heap == study.experiments.end()) return study;
  const PictureSet set = set_of(pictures);
  if (!set.heaps_deg) return study;
  dem::Measured& measured = heap->second.measured;
  measured.values.clear();
  for (const HeapOfSet& one : set.heaps) measured.values.push_back(one.angle_deg);
  if (set.own_deg > 0) measured.value_uncertainty = set.own_deg / base::kNormal95;
  if (set.within_sd_deg) measured.within_heaps = {set.pictures, *set.within_sd_deg};
  if (!(set.camera_deg > 0)) return study;
  const double sd = set.camera_deg / base::kNormal95;
  measured.systematic.push_back(
      {.name = "camera",
       .sd = sd,
       .note = fmt::format(
           "its pictures share ± {:.2g} deg by their camera's pitch and distance (standard "
           "uncertainty), which more pictures do not lower. Fix: save the pitch beside them "
           "(repose measure --pitch-deg 0 --save-hints), or put a board into them",
           sd)});
  return study;
}

namespace {

/// Readings taken in another way do not belong to this experiment.
void check_protocol(const dem::ExperimentEntry& entry, const dem::Protocol& protocol,
                    const std::vector<BenchReading>& readings, base::Faults& errors) {
  const std::vector<std::string> names = column_names(bench_test_named(entry.sheet.test));
  base::Faults rows(kMaxRowErrors);
  for (const auto& [column, key] : entry.sheet.protocol) {
    const auto index =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), column) - names.begin());
    const double meant = protocol_value(entry, protocol, key);
    for (const BenchReading& reading : readings) {
      const double value = reading.values[index];
      const auto half_width = reading.optional.find(uncertainty_column(column));
      const double uncertainty = half_width == reading.optional.end() ? 0 : half_width->second;
      if (std::abs(value - meant) <= kSameSetting * meant + uncertainty) continue;
      rows.add(
          {.where = reading.place,
           .value = fmt::format("{0} = {1:g}, and the study has {2} = {3:g} in [experiment.{4}]",
                                column, value, key, meant, entry.name),
           .rule = fmt::format("the same within {0:g} %{1}", 100 * kSameSetting,
                               uncertainty > 0 ? fmt::format(" and ± {:.2g}", uncertainty) : ""),
           .fix = fmt::format(
               "write {0} = {1:g} there if all readings were taken so, or leave the reading out.",
               key, value)});
    }
  }
  errors.add_all(rows.all());
}

/// Heights with and without air drag cannot be averaged.
void check_one_air(const std::string& sheet, const std::vector<BenchReading>& readings,
                   base::Faults& errors) {
  std::set<double> answers;
  for (const BenchReading& reading : readings) {
    const auto given = reading.optional.find(std::string(kInAirColumn));
    if (given != reading.optional.end()) answers.insert(given->second);
  }
  errors.require(answers.size() <= 1,
                 {.where = sheet,
                  .value = fmt::format("{} differs from row to row", kInAirColumn),
                  .rule = "all heights read in air (1), or all free of its drag (0)",
                  .fix = "make two sheets, of two studies."});
}

}  // namespace

SheetReadings readings_of_table(const dem::ExperimentEntry& entry,
                                const dem::StudyExperiment& described,
                                const std::filesystem::path& file, Table table, NoRows no_rows) {
  base::Faults errors;
  SheetReadings sheet{
      .experiment = std::string(entry.name), .file = file, .rows = 0, .notes = {}, .values = {}};
  const BenchTest test = bench_test_named(entry.sheet.test);
  const auto [readings, left_out, notes] = sheet_of(std::move(table), test, {}, no_rows, errors);
  for (const LeftOut& one : left_out) sheet.notes.push_back(text_of(one, sheet.file));
  sheet.notes.insert(sheet.notes.end(), notes.begin(), notes.end());
  check_protocol(entry, described.protocol, readings, errors);
  try {
    check_readings(test, readings);
  } catch (const base::InputError& error) {
    errors.add_all(error.faults());
  }
  check_one_air(sheet.file.filename().string(), readings, errors);
  errors.throw_if_any();
  const auto is_without_air = [](const BenchReading& reading) {
    const auto in_air = reading.optional.find(std::string(kInAirColumn));
    return in_air != reading.optional.end() && in_air->second == 0;
  };
  sheet.in_air = std::ranges::none_of(readings, is_without_air);
  sheet.rows = static_cast<int>(readings.size());
  sheet.values = sample_means(test, entry.sheet.value, readings);
  return sheet;
}

std::vector<SheetReadings> read_sheets(const dem::Study& study, NoRows no_rows) {
  std::vector<SheetReadings> sheets;
  base::Faults errors;
  for (const auto& [experiment, described] : study.experiments) {
    if (!described.measured.sheet) continue;
    try {
      const std::filesystem::path& file = *described.measured.sheet;
      sheets.push_back(readings_of_table(*experiment, described, file,
                                         read_table(file, NoRows::allowed), no_rows));
    } catch (const base::InputError& error) {
      errors.add_all(error.faults());
    }
  }
  errors.throw_if_any();
  return sheets;
}

dem::Study with_readings(dem::Study study, const std::vector<SheetReadings>& sheets) {
  for (const SheetReadings& sheet : sheets) {
    const dem::Experiment experiment = &dem::experiment_named(sheet.experiment);
    dem::Measured& measured = study.experiments.at(experiment).measured;
    measured.values = sheet.values;
    measured.in_air = measured.in_air && sheet.in_air;
  }
  return study;
}

dem::Study as_measured(dem::Study study, const dem::ClumpShape& grain,
                       const Measurement& measurement) {
  // Film tracking already accounts for the drag.
  study = with_films(without_air(with_readings(std::move(study), measurement.sheets), grain),
                     measurement.films);
  return with_pictures(std::move(study), measurement.pictures);
}

}  // namespace repose::calibrate
