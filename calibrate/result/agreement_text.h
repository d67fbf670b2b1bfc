#pragma once

#include <string>

#include "calibrate/fit/verification.h"
#include "calibrate/result/result.h"
#include "calibrate/study/study_run.h"

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

}  // namespace repose::calibrate
