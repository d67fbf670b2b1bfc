#pragma once

#include <string>
#include <vector>

#include "cli/measure/measure_batch.h"

namespace repose::cli {

/// A header and a row for each picture, quoted by RFC 4180. What does not exist is empty.
std::string measure_csv(const std::vector<MeasuredPicture>& pictures);

}  // namespace repose::cli
