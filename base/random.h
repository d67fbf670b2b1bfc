#pragma once

#include <cstdint>
#include <random>

namespace repose::base {

/// Random numbers that are the same on every platform: the standard fixes the engine, and the
/// mapping is ours (std::uniform_real_distribution's is not fixed).
class Random {
 public:
  /// Skips `draws` numbers, to resume a stream.
  explicit Random(std::uint64_t seed, std::uint64_t draws = 0) : engine_(seed), draws_(draws) {
    engine_.discard(draws);
  }

  /// Numbers drawn so far.
  std::uint64_t draws() const { return draws_; }

  /// 0 <= u < 1, 53 bits.
  double uniform() {
    ++draws_;
    return static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double between(double low, double high) { return low + (high - low) * uniform(); }

 private:
  std::mt19937_64 engine_;
  std::uint64_t draws_ = 0;
};

}  // namespace repose::base
