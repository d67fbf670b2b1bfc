#pragma once

#include <string>

#include "calibrate/fit/problem.h"

/// Jobs as text, to be sent to another process. Every number comes back to the last bit.
namespace repose::calibrate {

std::string text_of(const Job& job);
Job job_in(const std::string& text);

}  // namespace repose::calibrate
