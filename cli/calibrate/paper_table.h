#pragma once

#include <string>

#include "calibrate/result/result.h"
#include "dem/study/study.h"

namespace repose::cli {

/// Output of `repose calibrate --method paper`. `study` may have values of an earlier calibration.
std::string paper_table(const calibrate::PublishedResult& published, const dem::Study& study,
                        int columns);

}  // namespace repose::cli
