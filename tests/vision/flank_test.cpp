#include "vision/measure/flank.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/heap_random.h"
#include "tests/vision/pictures.h"
#include "tests/vision/profiles.h"

namespace repose::vision {
namespace {

using ::testing::AllOf;
using ::testing::Ge;
using ::testing::Le;

FlankFit fit(const Profile& profile, Side side, FlankOptions options = {}) {
  return fit_flank(profile, side, options);
}

/// A right flank of slope `slope` from its crest at x = 20, 100 high, modified by `change(u, h)`.
template <class Change>
Profile right_flank(double slope, Change change) {
  return profile_of(500, [&](double along) {
    const double u = along - 20.5;
    return u < 0 ? 100 + 0.5 * u : change(u, 100 - slope * u);
  });
}

TEST(FitFlank, StraightFlanksAreExact) {
  const Profile profile = profile_of(700, kTriangle);
  for (const auto& [side, angle] : {std::pair(Side::left, kLeft_rad), {Side::right, kRight_rad}}) {
    const FlankFit flank = fit(profile, side);
    ASSERT_EQ(flank.status, FlankStatus::ok) << flank.reason;
    EXPECT_NEAR(flank.angle_rad, angle, 1e-6);
    EXPECT_NEAR(std::atan(-flank.least_squares.slope), angle, 1e-9);
    EXPECT_NEAR(flank.least_squares.r2, 1, 1e-9);
    EXPECT_NEAR(flank.fit_error_rad, 0, 1e-6);
    EXPECT_NEAR(flank.window_spread_rad, 0, 1e-6);
    EXPECT_NEAR(flank.bend_rad, 0, 1e-6);
    EXPECT_FALSE(flank.apron || flank.frame_cut || flank.vertical);
  }
}

TEST(FitFlank, UsesTheWindowThatIsAskedFor) {
  const Profile profile = profile_of(700, kTriangle);
  for (const auto& [from, to] : {std::pair(0.2, 0.8), {0.1, 0.5}, {0.6, 0.95}}) {
    const FlankFit flank =
        fit(profile, Side::right, {.window_from = from, .window_to = to, .grain = 4});
    // One column is tan 30 high; the ends are whole columns.
    EXPECT_NEAR(flank.height.front(), to * 110, 1.2);
    EXPECT_NEAR(flank.height.back(), from * 110, 1.2);
    EXPECT_TRUE(std::is_sorted(flank.along.begin(), flank.along.end()));
  }
}

/// Angle of the line through the points of a height function between two fractions of its height.
template <class Height>
double definition(Height height, double crest, double from, double to) {
  std::vector<double> u;
  std::vector<double> h;
  for (double at = 0; height(at) > from * crest; at += 0.01) {
    if (height(at) > to * crest) continue;
    u.push_back(at);
    h.push_back(height(at));
  }
  return std::atan(-least_squares_line(u, h).slope);
}

TEST(FitFlank, HollowFlanksAreFittedWhereTheEdgeHasTheHeights) {
  // Power laws and exponentials whose halves differ by 4 to 13 degrees. Lines that end where they
  // themselves reach the window's heights are .4 to 2.6 degrees steeper.
  const auto power = [](double p) {
    return [p](double u) { return u < 400 ? 100 * std::pow(1 - u / 400, p) : 0; };
  };
  const auto fall = [](double rate) {
    return [rate](double u) {
      const double end = std::exp(-rate);
      return u < 400 ? 100 * (std::exp(-rate * u / 400) - end) / (1 - end) : 0;
    };
  };
  const auto expect_definition = [](auto height) {
    const Profile profile = right_flank(1, [&](double u, double) { return height(u); });
    for (const auto& [from, to] : {std::pair(0.2, 0.8), {0.3, 0.7}, {0.1, 0.9}}) {
      const FlankFit flank =
          fit(profile, Side::right,
              {.window_from = from, .window_to = to, .leave_apron_out = false, .grain = 4});
      EXPECT_NEAR(flank.angle_rad, definition(height, 100, from, to), 0.15 * kDegree);
      EXPECT_EQ(flank.window_from, from);
      EXPECT_EQ(flank.window_to, to);
      EXPECT_GT(flank.bend_rad, 0);
    }
  };
  expect_definition(power(1.5));
  expect_definition(power(2));
  expect_definition(fall(1.5));
  expect_definition(fall(2.5));
}

TEST(FitFlank, BumpsDoNotTurnTheLine) {
  // Bumps of a tenth of the height; whether one extends beyond the window must not matter.
  double mean_rad = 0;
  constexpr int kPhases = 12;
  for (int phase = 0; phase < kPhases; ++phase) {
    const Profile bumpy = right_flank(0.5, [&](double u, double h) {
      return std::max(0.0, h + 5 * std::sin(u / 4 + 2 * std::numbers::pi * phase / kPhases));
    });
    const FlankFit flank = fit(bumpy, Side::right, {.grain = 12});
    ASSERT_EQ(flank.status, FlankStatus::ok);
    // A wave of amplitude a and length w can turn a line of length l by 6 a w / (pi l^2): here
    // 0.017 of slope, 0.76 degrees.
    EXPECT_NEAR(flank.angle_rad, std::atan(0.5), 0.76 * kDegree);
    mean_rad += flank.angle_rad / kPhases;
  }
  EXPECT_NEAR(mean_rad, std::atan(0.5), 0.2 * kDegree);
}

TEST(FitFlank, AHollowToeBelowTheWindowDoesNotMatter) {
  const double slope = std::tan(28 * kDegree);
  const auto with_toe = [&](double u, double h) {
    const double knee = 82 / slope;  // 18 high; below it a third as steep
    return std::max(0.0, u < knee ? h : 18 - slope / 3 * (u - knee));
  };
  const FlankFit flank = fit(right_flank(slope, with_toe), Side::right, {.grain = 4});
  EXPECT_NEAR(flank.angle_rad, 28 * kDegree, 1e-6);
  // 10-90 % of the height includes the toe.
  EXPECT_GT(flank.window_spread_rad, 0.5 * kDegree);
}

TEST(FitFlank, ALedgeUnderWhichTheFlankGoesOnIsNoFoot) {
  const auto with_ledge = [](double u, double) {  // 2.5 grains wide, at .48 of the height
    return std::max(0.0, 100 - 0.5 * (u < 104 ? u : std::max(104.0, u - 30)));
  };
  const FlankFit flank = fit(right_flank(0.5, with_ledge), Side::right, {.grain = 12});
  EXPECT_FALSE(flank.apron);
}

TEST(FitFlank, AStepBetweenLargeGrainsOfUnknownSizeIsNoApron) {
  // Three grains high: the edge may be level anywhere over a grain's length.
  for (double phase = 0; phase < 6; phase += 0.5) {
    const Profile silhouette = right_flank(0.6, [&](double u, double h) {
      return std::max(0.0, h + 8 * std::sin(2 * std::numbers::pi * u / 30 + phase));
    });
    EXPECT_FALSE(fit(silhouette, Side::right).apron) << phase;
  }
}

TEST(FitFlank, AnUprightFaceIsNoFlank) {
  // A block with a level top, on a thin layer.
  const Profile block =
      profile_of(300, [](double along) { return along > 50 && along < 250 ? 120.0 : 5.0; });
  for (const Side side : {Side::left, Side::right}) {
    const FlankFit flank = fit(block, side);
    EXPECT_EQ(flank.status, FlankStatus::absent);
    EXPECT_TRUE(flank.vertical);
    EXPECT_THAT(flank.reason, ::testing::HasSubstr("vertical"));
  }
}

TEST(FitFlank, ABodyThatEndsAtItsCrestIsUprightThere) {
  const Profile half = right_flank(0.5, [](double, double h) { return std::max(0.0, h); });
  const FlankFit left = fit(half, Side::left);
  EXPECT_EQ(left.status, FlankStatus::absent);
  EXPECT_TRUE(left.vertical);
  EXPECT_NEAR(fit(half, Side::right).angle_rad, std::atan(0.5), 1e-6);
}

TEST(FitFlank, AHalfHeapAgainstTheFrameIsAbsentNotUpright) {
  Profile half = right_flank(0.5, [](double, double h) { return std::max(0.0, h); });
  half.leaves_frame_left = true;
  const FlankFit left = fit(half, Side::left);
  EXPECT_EQ(left.status, FlankStatus::absent);
  EXPECT_FALSE(left.vertical);
  EXPECT_FALSE(left.reason.empty());
}

/// The triangle's right flank, cut off by the frame at `fraction` of its height.
Profile cut_off_at(double fraction) {
  const double end = 350 + (1 - fraction) * 110 / std::tan(kRight_rad);
  Profile profile = profile_of(static_cast<int>(end), kTriangle);
  profile.leaves_frame_right = true;
  return profile;
}

TEST(FitFlank, AFlankCutLowIsMeasuredAbove) {
  const FlankFit flank = fit(cut_off_at(0.3), Side::right);
  ASSERT_EQ(flank.status, FlankStatus::ok);
  EXPECT_TRUE(flank.frame_cut);
  EXPECT_NEAR(flank.window_from, 0.3, 0.01);
  EXPECT_NEAR(flank.angle_rad, kRight_rad, 1e-6);
}

TEST(FitFlank, AFlankCutHighIsTruncated) {
  for (const double fraction : {0.35, 0.6}) {  // a quarter and two thirds of the window are missing
    const Profile profile = cut_off_at(fraction);
    EXPECT_EQ(fit(profile, Side::right).status, FlankStatus::truncated) << fraction;
    EXPECT_EQ(fit(profile, Side::left).status, FlankStatus::ok) << fraction;
  }
}

TEST(FitFlank, AFewColumnsAreNoFlank) {
  const FlankFit flank = fit(profile_of(16, Triangle{8, 8, 1, 1}), Side::right);
  EXPECT_EQ(flank.status, FlankStatus::absent);
}

TEST(FitFlank, BendIsPositiveForAHollowFlankAndNegativeForARoundOne) {
  const auto bent = [](double bend) {
    return right_flank(0.5, [=](double u, double h) {
      const double from_middle = (u - 100) / 100;
      return std::max(0.0, h + bend * (from_middle * from_middle - 1));
    });
  };
  // Slopes of the halves, 30 px either side of the middle: 0.5 +- 2 bend 0.3 / 100.
  const double change = std::atan(0.5 + 0.06) - std::atan(0.5 - 0.06);
  EXPECT_NEAR(fit(bent(10), Side::right).bend_rad, change, 0.15 * change);
  EXPECT_NEAR(fit(bent(-10), Side::right).bend_rad, -change, 0.15 * change);
}

TEST(FitFlank, TellsTheAngleOfOtherWindows) {
  const FlankFit flank = fit(profile_of(700, kTriangle), Side::left);
  ASSERT_EQ(flank.other_windows.size(), 2);
  EXPECT_EQ(flank.other_windows[0].window_from, 0.1);
  EXPECT_EQ(flank.other_windows[0].window_to, 0.9);
  EXPECT_EQ(flank.other_windows[1].window_from, 0.3);
  EXPECT_EQ(flank.other_windows[1].window_to, 0.7);
  for (const WindowAngle& window : flank.other_windows) {
    EXPECT_NEAR(window.angle_rad, kLeft_rad, 1e-6);
  }
}

TEST(FitFlank, LeftIsTheMirrorImageOfRight) {
  const auto bumpy = [](double along) { return kTriangle(along) + 3 * std::sin(along / 5); };
  const Profile profile = profile_of(700, bumpy);
  const Profile mirrored = profile_of(700, [&](double along) { return bumpy(700 - along); });
  const FlankFit right = fit(profile, Side::right, {.grain = 15});
  const FlankFit left = fit(mirrored, Side::left, {.grain = 15});
  EXPECT_NEAR(left.angle_rad, right.angle_rad, 1e-9);
  EXPECT_NEAR(left.fit_error_rad, right.fit_error_rad, 1e-9);
  EXPECT_NEAR(left.bend_rad, right.bend_rad, 1e-9);
}

/// A flank of grains 10 px long: a moving average over normal numbers.
Profile grainy(testing::Random& random) {
  std::vector<double> white;
  for (int i = 0; i < 600; ++i) white.push_back(random.normal(0, 2 * std::sqrt(10)));
  return right_flank(0.5, [&](double u, double h) {
    double sum = 0;
    for (int k = 0; k < 10; ++k)
      sum += white[static_cast<std::size_t>(u) + static_cast<std::size_t>(k)];
    return std::max(0.0, h + sum / 10);
  });
}

TEST(FitFlank, FitErrorIsTheAnglesScatter) {
  constexpr int kTrials = 200;  // determine the scatter to 5 %
  testing::Random random(2);
  double scatter = 0;
  double stated = 0;
  double noise = 0;
  for (int i = 0; i < kTrials; ++i) {
    const FlankFit flank = fit(grainy(random), Side::right, {.grain = 10});
    scatter += std::pow(flank.angle_rad - std::atan(0.5), 2) / kTrials;
    stated += std::pow(flank.fit_error_rad, 2) / kTrials;
    noise += flank.scatter / kTrials;
  }
  EXPECT_NEAR(noise, 2, 0.3);  // the fitted line absorbs a little of it
  // 120 columns contain only six blocks of two grains: the error estimate's own error is a quarter.
  EXPECT_NEAR(std::sqrt(stated / scatter), 1, 0.25);
}

TEST(FitFlank, SameSeedGivesTheSameBits) {
  testing::Random random(3);
  const Profile profile = grainy(random);
  const auto error = [&](std::uint64_t seed) {
    return fit(profile, Side::right, {.grain = 10, .seed = seed}).fit_error_rad;
  };
  EXPECT_EQ(error(1), error(1));
  EXPECT_NE(error(1), error(2));
}

TEST(FitFlank, GrainIsReadOffTheBumpsWhenUnknown) {
  const Profile bumpy =
      right_flank(0.25, [](double u, double h) { return std::max(0.0, h + 3 * std::sin(u / 2)); });
  // A bump is 2 pi 2 = 12.6 long; counting crossings may miss one of the twenty.
  EXPECT_THAT(fit(bumpy, Side::right).grain, AllOf(Ge(11), Le(14)));
}

}  // namespace
}  // namespace repose::vision
