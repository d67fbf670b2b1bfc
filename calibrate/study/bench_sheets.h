#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/statistics/table/table.h"
#include "dem/study/study.h"

/// Sheets of readings that a study names, as in measured = { readings = "drops.csv" }.
namespace repose::calibrate {

/// What a sheet gave.
struct SheetReadings {
  std::string experiment;
  std::filesystem::path file;
  int rows = 0;
  std::vector<std::string>
      notes;  ///< rows that were left out or may be no readings, a sentence each
  /// Of each grain, in the unit of the experiment: repeats on one grain are averaged first.
  std::vector<double> values;
  bool in_air = true;  ///< as dem::Measured::in_air: its column in_air
};

/// Reads all of them, in the order of the experiments. A sheet without rows has no values, or is an
/// error.
/// @throws base::InputError  every error of every sheet, "FILE:LINE: ..." each: see read_sheet
/// and check_readings; or another height of fall or incline than that of the study.
std::vector<SheetReadings> read_sheets(const dem::Study& study, NoRows no_rows);

/// The study with the sheets' values as its measured values.
dem::Study with_readings(dem::Study study, const std::vector<SheetReadings>& sheets);

}  // namespace repose::calibrate
