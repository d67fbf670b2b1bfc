#include "dem/experiment/random.h"

#include <cmath>
#include <numbers>

namespace repose::dem {

Quaternion Random::orientation() {
  // In this order: the order of evaluation of arguments is not fixed.
  const double share = uniform();
  const double first = 2 * std::numbers::pi * uniform();
  const double second = 2 * std::numbers::pi * uniform();
  const double a = std::sqrt(1 - share);
  const double b = std::sqrt(share);
  return Quaternion(b * std::cos(second), a * std::sin(first), a * std::cos(first),
                    b * std::sin(second))
      .normalized();
}

}  // namespace repose::dem
