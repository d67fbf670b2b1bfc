#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/runs/table_study.h"
#include "calibrate/statistics/table/table.h"

/// Cells of a table of runs that name a picture of the run's heap, a film of it or a file of its
/// particles, in place of a number: measured as a bench's pictures are.
namespace repose::calibrate {

struct PicturedCells {
  /// Standard uncertainties of the readings, by the row's line and the reading.
  std::map<int, std::map<std::string, double>> sds;
  std::vector<std::string> fingerprints;  ///< of the files
  std::vector<std::string> notes;         ///< what was measured, flagged and refused
};

/// Puts angles in place of the names; where a picture is refused, nothing: the row then has no
/// reading. Flagged ones count, as everywhere.
/// @param folder  that the names are relative to: the table's
/// @param faults  are added to: files that cannot be read, of readings that are no angles
PicturedCells measure_pictured_cells(const TableStudy& study, const std::filesystem::path& folder,
                                     Table& table, base::Faults& faults);

}  // namespace repose::calibrate
