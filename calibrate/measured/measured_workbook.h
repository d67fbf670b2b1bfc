#pragma once

#include <string>
#include <vector>

#include "calibrate/measured/measured_file.h"

namespace repose::calibrate {

/// The content of a spreadsheet workbook (XLSX, ECMA-376): a row for each picture as in
/// measure_csv(), with units; their mean as in set_json(); and the meaning of each column. The same
/// pictures give the same bytes.
/// @throws std::runtime_error  there is not enough space for it on this machine.
std::string measure_workbook(const std::vector<MeasuredPicture>& pictures);

}  // namespace repose::calibrate
