#pragma once

#include <string>
#include <vector>

#include "calibrate/measured/measured_file.h"

namespace repose::calibrate {

/// The content of a workbook (XLSX, ECMA-376) for spreadsheets: a row for each picture as
/// measure_csv() has it, with units, their mean as set_json() has it, and what each column is.
/// The same pictures give the same bytes.
/// @throws std::runtime_error  this machine has no room for it.
std::string measure_workbook(const std::vector<MeasuredPicture>& pictures);

}  // namespace repose::calibrate
