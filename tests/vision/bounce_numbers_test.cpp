#include <cmath>

#include <gtest/gtest.h>

#include "vision/track/drop_candidate.h"

namespace repose::vision {
namespace {

TEST(BounceNumbers, FollowFromTheTimeBetweenTwoFlights) {
  constexpr double kGravity_px_s2 = 9810;
  for (const double restitution : {.2, .5, .8, .95}) {
    double speed = 2400, gap_s = 0;
    for (int impacts = 1; impacts <= 4; ++impacts) {
      speed *= restitution;
      EXPECT_EQ(impacts_between(2400, speed, gap_s + .002, kGravity_px_s2), impacts) << restitution;
      gap_s += 2 * speed / kGravity_px_s2;
    }
  }
}

TEST(BounceNumbers, AreOneWhereTheNextFlightIsFaster) {
  EXPECT_EQ(impacts_between(1000, 1200, .3, 9810), 1);
}

}  // namespace
}  // namespace repose::vision
