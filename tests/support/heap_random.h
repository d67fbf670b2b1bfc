#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string_view>

namespace repose::testing {

/// Random numbers that are the same on every platform: the standard fixes the engine's output but
/// not its distributions' algorithms, so the mapping is our own.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

  /// Including both ends.
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }

  double normal(double mean, double sd) {
    const double radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
    return mean + sd * radius * std::cos(uniform(0, 2 * std::numbers::pi));
  }

  bool chance(double probability) { return uniform(0, 1) < probability; }

  template <class T, std::size_t count>
  const T& pick(const std::array<T, count>& items) {
    return items[engine_() % count];
  }

  std::uint64_t seed() { return engine_(); }

 private:
  std::mt19937_64 engine_;
};

/// FNV-1a: gives every condition its own stream of random numbers for the same seed.
inline std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

}  // namespace repose::testing
