#include "vision/film/frame_times.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>

namespace repose::vision {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

std::vector<double> even_times(int count, double step_s) {
  std::vector<double> times_s;
  for (int k = 0; k < count; ++k) times_s.push_back(k * step_s);
  return times_s;
}

std::vector<double> rounded(std::vector<double> times_s, double unit_s) {
  for (double& time_s : times_s) time_s = std::round(time_s / unit_s) * unit_s;
  return times_s;
}

TEST(UnroundedTimes, AreThoseBeforeMillisecondsWereRounded) {
  for (const double rate : {30., 59.94, 240., 480.}) {
    const std::vector<double> times_s = even_times(400, 1 / rate);
    const std::vector<double> found = unrounded_times(rounded(times_s, .001), .001);
    EXPECT_THAT(found, Pointwise(DoubleNear(2e-4), times_s)) << rate;
  }
}

TEST(UnroundedTimes, KeepGaps) {
  std::vector<double> times_s = even_times(300, 1 / 240.);
  times_s.erase(times_s.begin() + 100, times_s.begin() + 140);
  EXPECT_THAT(unrounded_times(rounded(times_s, .001), .001), Pointwise(DoubleNear(2e-4), times_s));
}

TEST(UnroundedTimes, LeaveWhatIsUnevenByItself) {
  std::vector<double> times_s;
  for (int k = 0; k < 100; ++k) times_s.push_back(k / 30. + .008 * std::sin(1.7 * k));
  const std::vector<double> stamps_s = rounded(times_s, .001);
  EXPECT_EQ(unrounded_times(stamps_s, .001), stamps_s);
  const std::vector<double> fine_s = even_times(100, 512 / 15360.);
  EXPECT_EQ(unrounded_times(fine_s, 1 / 15360.), fine_s);
}

/// Times from 0 with these steps between them.
std::vector<double> times_of(const std::vector<double>& steps_s) {
  std::vector<double> times_s = {0};
  for (const double step_s : steps_s) times_s.push_back(times_s.back() + step_s);
  return times_s;
}

TEST(RateChanges, AreFoundWhereStepsGrowOrShrinkForAWhile) {
  std::vector<double> steps_s(60, .01);
  std::fill(steps_s.begin() + 20, steps_s.begin() + 40, .015);
  const std::vector<RateChange> changes = rate_changes(times_of(steps_s));
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].frame, 20U);
  EXPECT_NEAR(changes[0].before_s, .01, 1e-12);
  EXPECT_NEAR(changes[0].after_s, .015, 1e-12);
  EXPECT_EQ(changes[1].frame, 40U);
  EXPECT_NEAR(changes[1].after_s, .01, 1e-12);
}

TEST(RateChanges, AreNeitherGapsNorJitterNorPatterns) {
  std::vector<double> gaps(60, .01), jitter(60, .01), pattern(60, .01);
  gaps[10] = gaps[30] = .2;
  for (std::size_t k = 0; k < jitter.size(); ++k) {
    jitter[k] += .003 * std::sin(12.9898 * static_cast<double>(k * k));
    if (k % 4 == 0) pattern[k] = .02;
  }
  EXPECT_TRUE(rate_changes(times_of(gaps)).empty());
  EXPECT_TRUE(rate_changes(times_of(jitter)).empty());
  EXPECT_TRUE(rate_changes(times_of(pattern)).empty());
  EXPECT_TRUE(rate_changes({}).empty());
}

TEST(FrameGrid, CountsTheStepsBehindUnsteadyStamps) {
  std::vector<double> stamps_s, steps;
  for (int k = 0; k < 300; ++k) {
    if (k > 120 && k < 126) continue;
    steps.push_back(k);
    stamps_s.push_back((k + .3 * std::sin(2.3 * k * k)) / 240);
  }
  const auto grid = grid_of(stamps_s);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->steps, steps);
  EXPECT_NEAR(grid->step_s, 1 / 240., 1e-5);
  EXPECT_NEAR(grid->off, .3 / std::sqrt(2), .03);
}

/// The change to each frame of a film that shows only the frames with these numbers, of an object
/// in flights of `flight` frames.
std::vector<double> changes_between(const std::vector<int>& shown, int flight) {
  std::vector<double> changes = {0};
  for (std::size_t k = 1; k < shown.size(); ++k) {
    const auto height = [&](int frame) {
      const double t = frame % flight - .5 * flight + .3;
      return t * t;
    };
    const double way = std::abs(height(shown[k]) - height(shown[k - 1]));
    changes.push_back(shown[k] == shown[k - 1] ? 40 : 200 + 1000 * way);
  }
  return changes;
}

std::vector<int> shown_at(int frames, double taken_per_shown) {
  std::vector<int> shown;
  for (int k = 0; k < frames; ++k) shown.push_back(static_cast<int>(taken_per_shown * k + .01));
  return shown;
}

TEST(RepeatedFrames, AreFoundWithWhenTheOthersWereTaken) {
  struct Case {
    double taken_per_shown;
    const char* what;
  };
  for (const Case& one : {Case{.5, "60 made 120"}, {5. / 6, "25 made 30"}, {.4, "24 made 60"}}) {
    const std::vector<int> shown = shown_at(120, one.taken_per_shown);
    const RepeatedFrames found = repeats_among(changes_between(shown, 23), even_times(120, 1));
    ASSERT_TRUE(found.taken_at) << one.what;
    for (std::size_t k = 1; k < shown.size(); ++k) {
      EXPECT_EQ(found.is_repeat[k], shown[k] == shown[k - 1]) << one.what << ", frame " << k;
      const double taken = found.taken_at->at(k) - found.taken_at->at(0);
      EXPECT_NEAR(taken, shown[k] / one.taken_per_shown, 1e-9) << one.what << ", frame " << k;
    }
  }
}

TEST(RepeatedFrames, WithoutAPatternKeepTheirTimes) {
  std::vector<int> shown = shown_at(120, 1);
  for (const std::size_t k :
       {7U, 10U, 16U, 20U, 31U, 43U, 46U, 55U, 58U, 65U, 69U, 76U, 83U, 90U, 97U, 101U, 112U}) {
    shown[k] = shown[k - 1];
  }
  const RepeatedFrames found = repeats_among(changes_between(shown, 23), even_times(120, 1));
  EXPECT_FALSE(found.taken_at);
  EXPECT_GE(found.count, 4);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    EXPECT_TRUE(!found.is_repeat[k] || shown[k] == shown[k - 1]) << k;
  }
}

TEST(RepeatedFrames, AreNoneWhereTheThingOnlySlowsDownOrRests) {
  EXPECT_EQ(repeats_among(changes_between(shown_at(200, 1), 40), even_times(200, 1)).count, 0);
  EXPECT_EQ(repeats_among(std::vector<double>(50, 0), even_times(50, 1)).count, 0);
}

}  // namespace
}  // namespace repose::vision
