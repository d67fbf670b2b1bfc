#pragma once

#include <cstddef>
#include <vector>

#include "calibrate/study/job_runner.h"
#include "cli/calibrate/calibrate_options.h"

namespace repose::cli {

/// The value nearest to the mean of all, of which there is one at least; of equals the first.
/// @return its number
std::size_t most_typical(const std::vector<double>& values);

/// Leaves the heaps of the last check in the study's folder, to look at and to compare with
/// photographs: all in `heaps`, that of the most typical angle also as `heap.vtp`. Those of an
/// earlier result go away: what is of other coefficients must not stand for these.
/// @throws base::InputError  the folder cannot be written.
void save_check_heaps(const CalibratePlan& plan, const calibrate::StudyContext& context,
                      const std::vector<calibrate::Run>& checks);

}  // namespace repose::cli
