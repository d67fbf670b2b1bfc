#include "vision/measure/edge_distance.h"

#include <algorithm>
#include <cmath>

namespace repose::vision {
namespace {

/// 0 beside the heap.
double height_at(const Profile& profile, double along) {
  const auto after = std::lower_bound(profile.along.begin(), profile.along.end(), along);
  if (after == profile.along.end()) return 0;
  if (after == profile.along.begin() && along < *after) return 0;
  return profile.height[static_cast<std::size_t>(after - profile.along.begin())];
}

}  // namespace

double edge_distance(const Reading& one, const Reading& other) {
  const double crest = one.profile.along[one.profile.crest];
  double squares = 0;
  std::size_t points = 0;
  for (const Side side : {Side::left, Side::right}) {
    const FlankFit& flank = one.flank(side);
    for (std::size_t i = 0; i < flank.along.size(); ++i) {
      const double along = side == Side::left ? crest - flank.along[i] : crest + flank.along[i];
      const double away = height_at(other.profile, along) - flank.height[i];
      squares += away * away;
    }
    points += flank.along.size();
  }
  if (points == 0) return 0;
  return std::sqrt(squares / static_cast<double>(points)) / one.profile.crest_height;
}

}  // namespace repose::vision
