#include "tests/support/flank_law.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/input_error.h"
#include "tests/support/edge_angle.h"
#include "tests/support/heap_conditions.h"
#include "tests/support/heap_draft.h"
#include "tests/support/heap_profile.h"

namespace repose::testing {
namespace {

constexpr double kSlope = .4;  // of the line from toe to apex
constexpr double kLength = 300;

/// An edge with one point per pixel and no rounding of the crest.
EdgeAngle angle_of(const FlankLaw& law) {
  std::vector<EdgePoint> edge;
  for (int i = 0; i <= kLength; ++i) {
    edge.push_back({.out = 1. * i, .height = kSlope * kLength * law.height(i / kLength)});
  }
  return angle_of_edge(edge, kSlope * kLength);
}

TEST(EdgeAngle, APowerOfOneIsAStraightFlank) {
  const EdgeAngle straight = angle_of({Flanks::power, 1});
  EXPECT_NEAR(straight.angle_rad, std::atan(kSlope), 1e-9);
  EXPECT_NEAR(straight.bend_rad, 0, 1e-9);
  EXPECT_NEAR(straight.high.out, .2 * kLength, 1e-9);
  EXPECT_NEAR(straight.low.out, .8 * kLength, 1e-9);
}

/// A parabola's least-squares line over any stretch is as steep as its chord there.
TEST(EdgeAngle, APowerOfTwoHasTheSlopeOfItsChord) {
  const double high = 1 - std::sqrt(.8);
  const double low = 1 - std::sqrt(.2);
  const double middle = (high + low) / 2;
  const EdgeAngle parabola = angle_of({Flanks::power, 2});
  EXPECT_NEAR(parabola.angle_rad, std::atan(kSlope * .6 / (low - high)), 1e-4);
  const auto chord_rad = [&](double from, double to) {
    return std::atan(kSlope * ((1 - from) + (1 - to)));
  };
  EXPECT_NEAR(parabola.bend_rad, chord_rad(high, middle) - chord_rad(middle, low), 1e-4);
}

/// The slope of the least-squares line of a function f over [a, b] with the middle m is
/// 12 / (b - a)^3 times the integral of (x - m) f(x).
TEST(EdgeAngle, AnExponentialHasTheSlopeOfItsIntegral) {
  constexpr double k = 1.7;
  const double foot = std::exp(-k);
  const auto place = [&](double height) { return -std::log(height * (1 - foot) + foot) / k; };
  const double a = place(.8);
  const double b = place(.2);
  const double m = (a + b) / 2;
  const auto integral_to = [&](double x) {
    return -std::exp(-k * x) * ((x - m) / k + 1 / (k * k));
  };
  const double slope = 12 / std::pow(b - a, 3) * (integral_to(b) - integral_to(a)) / (1 - foot);
  EXPECT_NEAR(angle_of({Flanks::exponential, k}).angle_rad, std::atan(-slope * kSlope), 1e-4);
}

TEST(EdgeAngle, BumpsDoNotMoveTheWindowOfASmoothEdge) {
  std::vector<EdgePoint> smooth;
  std::vector<EdgePoint> bumpy;
  for (int i = 0; i <= kLength; ++i) {
    smooth.push_back({.out = 1. * i, .height = kLength - i});
    bumpy.push_back({.out = 1. * i, .height = kLength - i + (i % 40 < 20 ? 5. : -5.)});
  }
  const EdgeAngle found = angle_of_edge(bumpy, kLength, smooth);
  EXPECT_NEAR(found.high.out, .2 * kLength, 1e-9);
  EXPECT_NEAR(found.low.out, .8 * kLength, 1e-9);
}

TEST(EdgeAngle, AnEdgeThatEndsWithinTheWindowIsRefused) {
  const std::vector<EdgePoint> edge = {{0, 10}, {10, 4}};
  EXPECT_THROW(angle_of_edge(edge, 10), std::invalid_argument);
}

TEST(FlankLaw, FallsFromTheApexToTheToe) {
  for (const FlankLaw& law : {FlankLaw(Flanks::straight, 3), FlankLaw(Flanks::power, 1.6),
                              FlankLaw(Flanks::exponential, 2)}) {
    EXPECT_NEAR(law.height(0), 1, 1e-12);
    EXPECT_NEAR(law.height(1), 0, 1e-12);
    EXPECT_NEAR(law.height(law.out_at(.3)), .3, 1e-12);
    const double out = law.out_at(.3);
    EXPECT_NEAR(law.steepness(.3), (law.height(out - 1e-5) - law.height(out + 1e-5)) / 2e-5, 1e-6);
  }
  EXPECT_NEAR(FlankLaw(Flanks::straight, 3).height(.25), .75, 1e-12);
}

TEST(FlankLaw, IsAsHollowAsItIsAskedFor) {
  for (const Flanks flanks : {Flanks::power, Flanks::exponential}) {
    for (const double bend_deg : {3., 8.}) {
      const double hollow = hollow_of_bend(flanks, kSlope, radians(bend_deg));
      EXPECT_NEAR(angle_of({flanks, hollow}).bend_rad, radians(bend_deg), 1e-3);
    }
  }
}

TEST(HeapProfile, AStraightFlankHasTheAngleOfItsForm) {
  const HeapForm form{.left_rad = .4, .right_rad = .5};
  const HeapProfile profile(form, 1200, 0);
  EXPECT_NEAR(profile.angle(Side::left)->angle_rad, .4, 1e-9);
  EXPECT_NEAR(profile.angle(Side::right)->angle_rad, .5, 1e-9);
}

TEST(HeapProfile, ItsCurveOfAHollowHeapIsSmoothAtTheCrestAndLowersNoWindow) {
  const HeapForm form{.left_rad = .4, .right_rad = .5, .flanks = Flanks::power, .hollow = 2};
  const HeapProfile profile(form, 1200, 0);
  EXPECT_NEAR(profile.height_at(profile.apex_x()), profile.height_px(), .02 * profile.height_px());
  // The line over a parabola's window, which is relative to the height of the rounded heap.
  const double apex = .6 * 1200 / (1 / std::tan(.4) + 1 / std::tan(.5));
  const double sum =
      std::sqrt(.2 * profile.height_px() / apex) + std::sqrt(.8 * profile.height_px() / apex);
  EXPECT_NEAR(profile.angle(Side::left)->angle_rad, std::atan(std::tan(.4) * sum), 1e-4);
}

/// Straight flanks are exact; hollow ones bend by 3 to 8 degrees, as in photographs.
TEST(HeapProfile, HollowConditionsBend) {
  for (const char* name : {"hollow_power", "hollow_exponential", "hollow_half_heap", "hollow_apron",
                           "few_grains_hollow"}) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const HeapScene scene = condition_named(name).scene(seed);
      const HeapProfile profile(scene.form, scene.width, 0);
      for (const Side side : {Side::left, Side::right}) {
        const auto angle = profile.angle(side);
        if (!angle) continue;
        EXPECT_GT(angle->bend_rad, radians(3)) << name << ' ' << seed;
        EXPECT_LT(angle->bend_rad, radians(8)) << name << ' ' << seed;
      }
    }
  }
}

}  // namespace
}  // namespace repose::testing
