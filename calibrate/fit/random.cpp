#include "calibrate/fit/random.h"

#include <cmath>
#include <numbers>

namespace repose::calibrate {

double Random::normal() {
  const double radius = std::sqrt(-2 * std::log(uniform()));
  return radius * std::cos(2 * std::numbers::pi * uniform());
}

}  // namespace repose::calibrate
