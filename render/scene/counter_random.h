#pragma once

#include <cstdint>

namespace repose::render {

/// A well-mixed number for each counter: stateless random numbers, any of which can be computed at
/// any time. Source: Steele, Lea & Flood, Fast splittable pseudorandom number generators, OOPSLA
/// 2014 (SplitMix64).
constexpr std::uint64_t mixed(std::uint64_t counter) {
  std::uint64_t z = counter + 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// 0 <= u < 1.
constexpr double uniform(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// Mean 0, standard deviation 1, within +- 3.46: the sum of four uniform numbers.
constexpr double nearly_normal(std::uint64_t bits) {
  constexpr double kPart = 65536;
  const double sum = static_cast<double>(bits & 0xffff) +
                     static_cast<double>((bits >> 16) & 0xffff) +
                     static_cast<double>((bits >> 32) & 0xffff) + static_cast<double>(bits >> 48);
  constexpr double kRootThree = 1.7320508075688772;  // a sum of four has the variance 4 / 12
  return kRootThree * ((sum + 2) / kPart - 2);
}

}  // namespace repose::render
