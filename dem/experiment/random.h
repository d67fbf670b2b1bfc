#pragma once

#include "base/random.h"
#include "dem/vector.h"

namespace repose::dem {

/// Random numbers that are the same everywhere, and random rotations.
class Random : public base::Random {
 public:
  using base::Random::Random;

  /// Uniform over all rotations.
  ///
  /// Source: Shoemake (1992), Uniform random rotations, Graphics Gems III, p. 124: a point spread
  /// evenly over the unit sphere in four dimensions. Proved by Random.* in
  /// tests/dem/experiment_random_test.cpp.
  Quaternion orientation();
};

}  // namespace repose::dem
