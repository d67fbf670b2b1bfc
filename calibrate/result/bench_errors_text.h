#pragma once

#include <string>

#include "calibrate/result/result.h"

/// What of a bench's uncertainty more readings do not lower, and what of it nobody measured, in
/// words for terminal and report.
namespace repose::calibrate {

/// "± 0.3 deg (bias_sd 0.25, air_drag 0.17), which more readings do not lower"; empty: nothing.
std::string systematic_text(const ResultObservable& observable);

/// "the model is taken to miss readings by drop 2.0 mm, tilt 0.11 deg (standard deviation): ...":
/// how wrong it is in the fit, and why it is that. Empty: it is taken to have no error.
std::string model_error_text(const JointResult& joint);

/// "if single readings of roll scatter by 35 %": what a coefficient's verdict takes for granted.
/// Empty: nothing, or nothing is determined.
std::string condition_text(const JointResult& joint, const ResultParameter& parameter);

}  // namespace repose::calibrate
