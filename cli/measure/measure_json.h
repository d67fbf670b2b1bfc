#pragma once

#include <string>
#include <vector>

#include "cli/measure/measure.h"

namespace repose::cli {

/// A header and a row for each picture, quoted by RFC 4180. What does not exist is empty.
std::string measure_csv(const std::vector<MeasuredPicture>& pictures);

/// An array with an object for each picture. A number that does not exist is null.
std::string measure_json(const std::vector<MeasuredPicture>& pictures);

}  // namespace repose::cli
