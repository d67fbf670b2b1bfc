#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "calibrate/measured/measured_file.h"

namespace repose::calibrate {

/// A cell for each of measured_columns(). What does not exist is empty.
std::vector<std::string> measured_cells(const MeasuredPicture& picture);

/// A header and a row for each picture, quoted by RFC 4180.
std::string measure_csv(const std::vector<MeasuredPicture>& pictures);

/// An object with all that is known of a picture. A number that does not exist is null.
nlohmann::ordered_json measured_json(const MeasuredPicture& picture);

/// An array with these objects.
std::string measure_json(const std::vector<MeasuredPicture>& pictures);

}  // namespace repose::calibrate
