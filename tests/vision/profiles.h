#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/units.h"
#include "vision/measure/profile.h"

/// Upper edges made of exact lines.
namespace repose::vision {

/// The profile of a height function over `columns` columns, where it is above the ground.
template <class Height>
Profile profile_of(int columns, Height height) {
  Profile profile;
  for (int col = 0; col < columns; ++col) {
    const double here = height(col + 0.5);
    if (here <= 0) continue;
    profile.along.push_back(col + 0.5);
    profile.height.push_back(here);
  }
  const auto& heights = profile.height;
  profile.crest_height = *std::max_element(heights.begin(), heights.end());
  const auto first = std::find(heights.begin(), heights.end(), profile.crest_height);
  const auto last = std::find(heights.rbegin(), heights.rend(), profile.crest_height).base() - 1;
  profile.crest = static_cast<std::size_t>((first - heights.begin() + last - heights.begin()) / 2);
  return profile;
}

/// A heap with straight flanks from its feet to its crest.
struct Triangle {
  double crest_along = 0;
  double crest_height = 0;
  double left_slope = 0;
  double right_slope = 0;

  double operator()(double along) const {
    const double slope = along < crest_along ? left_slope : right_slope;
    return std::max(0.0, crest_height - slope * std::abs(along - crest_along));
  }
};

/// A heap with unequal sides: their angles and its shape.
inline constexpr double kLeft_rad = 20 * kDegree;
inline constexpr double kRight_rad = 30 * kDegree;
inline const Triangle kTriangle{350, 110, std::tan(kLeft_rad), std::tan(kRight_rad)};

}  // namespace repose::vision
