#include "calibrate/fit/sequence.h"

#include <cmath>

namespace repose::calibrate {

Point sequence_point(std::size_t index, std::size_t dimensions) {
  double phi = 2;
  // x^(d+1) = x + 1 as a fixed point; contracts by at least 1 / (d + 1) each time.
  for (int i = 0; i < 64; ++i) phi = std::pow(1 + phi, 1 / (static_cast<double>(dimensions) + 1));
  Point point;
  for (std::size_t i = 0; i < dimensions; ++i) {
    const double step = std::pow(phi, -static_cast<double>(i + 1));
    double whole = 0;
    point.push_back(std::modf(.5 + static_cast<double>(index + 1) * step, &whole));
  }
  return point;
}

}  // namespace repose::calibrate
