#pragma once

#include <string>
#include <vector>

#include "calibrate/result/result.h"

/// What a calibration found, in the sentences that terminal and report both begin with.
namespace repose::calibrate {

/// What was held out and predicted, then what agrees and what does not, then which coefficients are
/// determined: sentences with capital letter and full stop, the most telling first.
std::vector<std::string> summary_sentences(const JointResult& joint);

/// Whether a coefficient has no value of its own, so that only whole sets of them can be used.
bool has_open_coefficients(const JointResult& joint);

/// The fitted values, then the equally good sets: set number 1 is the first. A row of values
/// belongs together.
std::vector<EquivalentSet> good_sets(const JointResult& joint);

/// What to do with them: a sentence.
inline constexpr const char* kUseOneRow =
    "Use one row together: values of different rows, or taken singly out of the intervals, need "
    "not "
    "fit these measurements.";

}  // namespace repose::calibrate
