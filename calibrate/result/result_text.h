#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/verification.h"
#include "calibrate/result/result.h"
#include "calibrate/study/study_run.h"

/// What a calibration found, and what of the bench's uncertainty nobody measured or more readings
/// would not lower, in the sentences that terminal and report share.

namespace repose::calibrate {

/// The verdict on bench and simulation in plain words: a sentence or more, without a capital letter
/// at its beginning. `degrees`: of freedom that the fit has left. Below one agreement is no test.
std::string agreement_text(const Verification& verification, double degrees);

/// "chi-square 5.31 of 1.0 degrees of freedom: ...". Empty for results that do not say.
std::string freedom_text(const JointResult& joint);

/// What one observable's verdict comes from: "+1.20 deg, tolerance 2 deg: ...".
std::string agreement_text(const Agreement& agreement, const std::string& unit);

/// On what bound an interval ends, and what the study says of it: "it ends at 0.8, a bound that
/// ...". Empty where it ends at none.
std::string bounds_text(const ResultParameter& parameter);

/// Where a margin comes from: "10 % of the reading". Empty for results that do not say.
std::string margin_text(const std::optional<MarginSource>& source);

/// What a reading that was held out is predicted as, and what was possible: "heap: predicted 23.4 ±
/// 1.0 deg, where 12.0 to 38.0 was possible; ...".
std::string prediction_text(const Prediction& prediction);

/// What the check of the number of spheres leaves open, and why: sentences. Empty: nothing.
std::string shape_check_text(const ShapeCheck& shape);

/// "± 0.3 deg (bias_sd 0.25, air_drag 0.17), which more readings do not lower"; empty: nothing.
std::string systematic_text(const ResultObservable& observable);

/// "the model is taken to miss readings by drop 2.0 mm, tilt 0.11 deg (standard deviation): ...":
/// how wrong it is in the fit, and why it is that. Empty: it is taken to have no error.
std::string model_error_text(const JointResult& joint);

/// What runs of larger grains are taken to read more than the study's; empty where there are none.
std::string coarse_text(const JointResult& joint);

/// Which changes were simulated with larger grains than the study's. Empty: none was.
std::string larger_grains_text(const std::vector<SensitivityCheck>& checks);

/// "if single readings of roll scatter by 35 %": what a coefficient's verdict takes for granted.
/// Empty: nothing, or nothing is determined.
std::string condition_text(const JointResult& joint, const ResultParameter& parameter);

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
