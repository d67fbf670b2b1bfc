#pragma once

namespace repose::calibrate {

/// What a tenth of the stiffness adds to a reading, and the standard uncertainty of that.
struct SofteningShift {
  double mean = 0;
  double uncertainty = 0;
};

}  // namespace repose::calibrate
