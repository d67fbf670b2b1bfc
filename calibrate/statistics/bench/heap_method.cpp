#include "calibrate/statistics/bench/method.h"
#include "calibrate/statistics/bench/units.h"

namespace repose::calibrate {

Method heap_method() {
  return {.source = "mean of the heaps",
          .columns = {{"angle_deg", "angle of repose", kFromZero, kRightAngle_deg}},
          .outputs = {{"angle_of_repose", "deg", "angle of repose",
                       [](ReadingValues v) { return v[0]; }, 0, kRightAngle_deg}},
          .error = {},
          .validity =
              "No material constant: it belongs to heaps of this size, made on this base in this "
              "way."};
}

}  // namespace repose::calibrate
