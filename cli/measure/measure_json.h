#pragma once

#include <string>
#include <vector>

#include "cli/measure/measure_batch.h"

namespace repose::cli {

/// An array with an object for each picture. A number that does not exist is null.
std::string measure_json(const std::vector<MeasuredPicture>& pictures);

}  // namespace repose::cli
