#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "calibrate/fit/problem.h"
#include "calibrate/study/job_runner.h"

namespace repose::calibrate {

/// The value nearest to the mean of all; of equal ones the first. There must be at least one.
/// @return its index
std::size_t most_typical(const std::vector<double>& values);

/// Saves the heaps of the last check in the study's folder, to look at and to compare with
/// photographs: all in `heaps`, that of the most typical angle also as `heap.vtp`. Those of an
/// earlier result are removed: they must not be mistaken for heaps of these coefficients.
/// @throws base::InputError  the folder cannot be written.
void save_check_heaps(const std::filesystem::path& folder, const StudyContext& context,
                      const std::vector<Run>& checks);

}  // namespace repose::calibrate
