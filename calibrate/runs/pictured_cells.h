#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/runs/table_study.h"
#include "calibrate/statistics/table/table.h"

/// Cells of a table of runs that name a picture or film of the run's heap, or a file of its
/// particles, in place of a number: measured like a bench's pictures.
namespace repose::calibrate {

struct PicturedCells {
  /// Standard uncertainties of the readings, by the row's line and the reading.
  std::map<int, std::map<std::string, double>> sds;
  std::vector<std::string> fingerprints;  ///< of the files
  std::vector<std::string> notes;         ///< what was measured, flagged and refused
};

/// Replaces the names by angles, or by nothing if a picture is refused: the row then has no
/// reading. Flagged ones count, as everywhere.
/// @param folder  base of relative names: that of the table
/// @param faults  appended to: files that cannot be read, or of readings that are not angles
PicturedCells measure_pictured_cells(const TableStudy& study, const std::filesystem::path& folder,
                                     Table& table, base::Faults& faults);

}  // namespace repose::calibrate
