#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "calibrate/measured/measured_file.h"

namespace repose::calibrate {

/// A cell for each of measured_columns(). Missing values are empty.
std::vector<std::string> measured_cells(const MeasuredPicture& picture);

/// A header and a row for each picture, quoted as in RFC 4180.
std::string measure_csv(const std::vector<MeasuredPicture>& pictures);

/// An object with everything known about a picture. Missing numbers are null.
nlohmann::ordered_json measured_json(const MeasuredPicture& picture);

/// An array with these objects.
std::string measure_json(const std::vector<MeasuredPicture>& pictures);

}  // namespace repose::calibrate
