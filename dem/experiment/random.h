#pragma once

#include <cstdint>
#include <random>

#include "dem/vector.h"

namespace repose::dem {

/// Random numbers that are the same everywhere: the standard fixes the engine, and the mapping is
/// ours (that of std::uniform_real_distribution is not fixed).
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// 0 <= u < 1, 53 bits.
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * uniform(); }

  /// Uniform over all rotations.
  ///
  /// Source: Shoemake (1992), Uniform random rotations, Graphics Gems III, p. 124: a point spread
  /// evenly over the unit sphere in four dimensions. Proved by Random.* in
  /// tests/dem/experiment_random_test.cpp.
  Quaternion orientation();

 private:
  std::mt19937_64 engine_;
};

}  // namespace repose::dem
