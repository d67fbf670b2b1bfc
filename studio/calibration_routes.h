#pragma once

#include "studio/calibrations.h"
#include "studio/http.h"

namespace repose::studio {

/// What the page asks of calibrations. What an address gives is said in calibration_routes.cpp
/// beside it.
void serve_calibrations(httplib::Server& http, Calibrations& calibrations);

}  // namespace repose::studio
