#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/verification.h"
#include "calibrate/result/result.h"
#include "calibrate/study/study_run.h"

/// The findings of a calibration, and the parts of the bench's uncertainty that were not measured
/// or that more readings would not reduce, in sentences shared by terminal and report.

namespace repose::calibrate {

/// The verdict on bench and simulation in plain words: one or more sentences, starting in lower
/// case. `degrees`: remaining degrees of freedom of the fit; below one, agreement is no test.
std::string agreement_text(const Verification& verification, double degrees);

/// "chi-square 5.31 of 1.0 degrees of freedom: ...". Empty for results without it.
std::string freedom_text(const JointResult& joint);

/// The basis of one observable's verdict: "+1.20 deg, tolerance 2 deg: ...".
std::string agreement_text(const Agreement& agreement, const std::string& unit);

/// The bound at which an interval ends, and what the study states about it: "it ends at 0.8, a
/// bound that ...". Empty if it ends at none.
std::string bounds_text(const ResultParameter& parameter);

/// The source of a margin: "10 % of the reading". Empty for results without it.
std::string margin_text(const std::optional<MarginSource>& source);

/// The prediction of a held-out reading, and what was possible: "heap: predicted 23.4 ± 1.0 deg,
/// where 12.0 to 38.0 was possible; ...".
std::string prediction_text(const Prediction& prediction);

/// What the check of the number of spheres leaves open, and why, in sentences. Empty: nothing.
std::string shape_check_text(const ShapeCheck& shape);

/// "± 0.3 deg (bias_sd 0.25, air_drag 0.17), which more readings do not lower"; empty: nothing.
std::string systematic_text(const ResultObservable& observable);

/// "the model is taken to miss readings by drop 2.0 mm, tilt 0.11 deg (standard deviation): ...":
/// the model error in the fit, and its reason. Empty: the model is assumed to have no error.
std::string model_error_text(const JointResult& joint);

/// By how much readings of runs with larger grains are assumed to exceed the study's; empty if
/// there are none.
std::string coarse_text(const JointResult& joint);

/// Which changes were simulated with larger grains than the study's. Empty: none.
std::string larger_grains_text(const std::vector<SensitivityCheck>& checks);

/// "if single readings of roll scatter by 35 %": the assumption behind a coefficient's verdict.
/// Empty: none, or nothing is determined.
std::string condition_text(const JointResult& joint, const ResultParameter& parameter);

/// Predictions of held-out readings, then what agrees and what does not, then which coefficients
/// are determined: full sentences, the most important first.
std::vector<std::string> summary_sentences(const JointResult& joint);

/// Whether any coefficient is not determined on its own, so that only whole sets can be used.
bool has_open_coefficients(const JointResult& joint);

/// The fitted values, then the equally good sets; set number 1 is the first. Values of one row
/// belong together.
std::vector<EquivalentSet> good_sets(const JointResult& joint);

/// How to use them, as a sentence.
inline constexpr const char* kUseOneRow =
    "Use one row together: values of different rows, or taken singly out of the intervals, need "
    "not "
    "fit these measurements.";

}  // namespace repose::calibrate
