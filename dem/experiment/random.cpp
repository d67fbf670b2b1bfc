#include "dem/experiment/random.h"

#include <cmath>
#include <numbers>

namespace repose::dem {

Quaternion Random::orientation() {
  // In this order: the order of evaluation of arguments is not fixed.
  const double fraction = uniform();
  const double first = 2 * std::numbers::pi * uniform();
  const double second = 2 * std::numbers::pi * uniform();
  const double a = std::sqrt(1 - fraction);
  const double b = std::sqrt(fraction);
  return Quaternion(b * std::cos(second), a * std::sin(first), a * std::cos(first),
                    b * std::sin(second))
      .normalized();
}

}  // namespace repose::dem
