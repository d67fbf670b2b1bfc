#pragma once

#include <cstddef>
#include <vector>

#include "vision/track/flight_finder.h"

namespace repose::vision {

struct Parabola {
  double acceleration = 0;
  double rms_px = 0;
  double error = 0;  ///< standard error of the acceleration
};

/// Least squares through `count` sightings from `from` on: of their heights over time.
Parabola parabola_through(const std::vector<SeenAt>& path, std::size_t from, std::size_t count);

}  // namespace repose::vision
