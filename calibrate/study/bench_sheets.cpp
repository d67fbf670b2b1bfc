#include "calibrate/study/bench_sheets.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "calibrate/statistics/bench/sheet.h"
#include "calibrate/study/bench_setting.h"
#include "dem/study/experiment_table.h"

namespace repose::calibrate {
namespace {

/// Readings taken in another way are no readings of this experiment.
void check_protocol(const dem::ExperimentEntry& entry, const dem::Protocol& protocol,
                    const std::vector<BenchReading>& readings, base::Faults& errors) {
  const std::vector<std::string> names = column_names(bench_test_named(entry.sheet.test));
  base::Faults rows(kMostRowErrors);
  for (const auto& [column, key] : entry.sheet.protocol) {
    const auto index =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), column) - names.begin());
    const double meant = protocol_value(entry, protocol, key);
    for (const BenchReading& reading : readings) {
      const double value = reading.values[index];
      if (std::abs(value - meant) <= kSameSetting * meant) continue;
      rows.add(
          {.where = reading.place,
           .value = fmt::format("{0} = {1:g}, and the study has {2} = {3:g} in [experiment.{4}]",
                                column, value, key, meant, entry.name),
           .rule = fmt::format("the same within {0:g} %", 100 * kSameSetting),
           .fix = fmt::format(
               "write {0} = {1:g} there if all readings were taken so, or leave the reading out.",
               key, value)});
    }
  }
  errors.add_all(rows.all());
}

/// Heights with and without air have no common mean.
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

SheetReadings read_sheet_of(const dem::ExperimentEntry& entry,
                            const dem::StudyExperiment& described, NoRows no_rows,
                            base::Faults& errors) {
  SheetReadings sheet{.experiment = std::string(entry.name),
                      .file = *described.measured.sheet,
                      .rows = 0,
                      .notes = {},
                      .values = {}};
  const BenchTest test = bench_test_named(entry.sheet.test);
  const auto [readings, left_out, notes] = read_sheet(sheet.file, test, {}, no_rows, errors);
  for (const LeftOut& one : left_out) sheet.notes.push_back(text_of(one, sheet.file));
  sheet.notes.insert(sheet.notes.end(), notes.begin(), notes.end());
  check_protocol(entry, described.protocol, readings, errors);
  check_readings(test, readings);
  check_one_air(sheet.file.filename().string(), readings, errors);
  const auto is_without_air = [](const BenchReading& reading) {
    const auto in_air = reading.optional.find(std::string(kInAirColumn));
    return in_air != reading.optional.end() && in_air->second == 0;
  };
  sheet.in_air = std::ranges::none_of(readings, is_without_air);
  sheet.rows = static_cast<int>(readings.size());
  sheet.values = sample_means(test, entry.sheet.value, readings);
  return sheet;
}

}  // namespace

std::vector<SheetReadings> read_sheets(const dem::Study& study, NoRows no_rows) {
  std::vector<SheetReadings> sheets;
  base::Faults errors;
  for (const auto& [experiment, described] : study.experiments) {
    if (!described.measured.sheet) continue;
    try {
      sheets.push_back(read_sheet_of(dem::entry_of(experiment), described, no_rows, errors));
    } catch (const base::InputError& error) {
      errors.add_all(error.faults());
    }
  }
  errors.throw_if_any();
  return sheets;
}

dem::Study with_readings(dem::Study study, const std::vector<SheetReadings>& sheets) {
  for (const SheetReadings& sheet : sheets) {
    const dem::Experiment experiment = dem::experiment_named(sheet.experiment).experiment;
    dem::Measured& measured = study.experiments.at(experiment).measured;
    measured.values = sheet.values;
    measured.in_air = measured.in_air && sheet.in_air;
  }
  return study;
}

}  // namespace repose::calibrate
