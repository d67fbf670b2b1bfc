#pragma once

#include <vector>

#include "base/input_error.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/study/study.h"

namespace repose::calibrate {

/// Readings that no bench with this grain and protocol can give, one error for each experiment that
/// has one: a bulk density of 1.403 kg/m3, a rebound above the drop. Files of readings must have
/// been read before. Proved by BenchSheets.ImpossibleReadings* in tests/calibrate.
std::vector<base::Fault> impossible_readings(const dem::Study& study, const dem::ClumpShape& grain);

}  // namespace repose::calibrate
