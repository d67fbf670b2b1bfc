#pragma once

#include <cstdint>
#include <random>

namespace repose::calibrate {

/// Random numbers that are the same everywhere: the standard fixes the engine, not the
/// distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// 0 < u < 1.
  double uniform() { return (static_cast<double>(engine_() >> 11) + .5) * 0x1p-53; }

  /// 0 ... count - 1.
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count));
  }

  /// Normal, mean 0, sd 1: Box and Muller (1958), Ann. Math. Stat. 29, 610.
  double normal();

 private:
  std::mt19937_64 engine_;
};

}  // namespace repose::calibrate
