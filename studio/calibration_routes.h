#pragma once

#include "studio/calibrations.h"
#include "studio/http.h"

namespace repose::studio {

/// The page's requests about calibrations. Routes are documented in calibration_routes.cpp.
void serve_calibrations(httplib::Server& http, Calibrations& calibrations);

}  // namespace repose::studio
