#pragma once

#include <string>

#include "calibrate/fit/verification.h"
#include "calibrate/study/study_run.h"

namespace repose::calibrate {

/// The verdict on bench and simulation in plain words: a sentence or more, without a capital letter
/// at its beginning.
std::string agreement_text(const Verification& verification);

/// What one observable's verdict comes from: "+1.20 deg, tolerance 2 deg: ...".
std::string agreement_text(const Agreement& agreement, const std::string& unit);

/// What the check of the number of spheres leaves open, and why: sentences. Empty: nothing.
std::string shape_check_text(const ShapeCheck& shape);

}  // namespace repose::calibrate
