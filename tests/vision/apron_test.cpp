#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "base/units.h"
#include "tests/support/flank_law.h"
#include "tests/support/heap_random.h"
#include "tests/vision/profiles.h"
#include "vision/measure/flank.h"
#include "vision/measure/uncertainty.h"

/// Heaps with aprons: feet that are much flatter than the flank above them.
namespace repose::vision {
namespace {

using repose::testing::FlankLaw;
using repose::testing::Flanks;
using repose::testing::Random;

constexpr double kHeight = 110;
constexpr double kSlope = 0.45;  // of the line from toe to crest
constexpr double kLength = kHeight / kSlope;

struct Measured {
  FlankFit fit;
  double interval_rad = 0;
};

/// The right flank of a heap that falls as `height(u)`, where that is above 0.
template <class Height>
Measured measured_flank(Height height, double grain) {
  const Profile profile = profile_of(1200, [&](double along) {
    const double u = along - 20.5;
    return u < 0 ? kHeight + 0.5 * u : height(u);
  });
  SelectedCandidate choice;
  choice.best.right = fit_flank(profile, Side::right, {.grain = grain});
  return {choice.best.right, uncertainty_of(choice).right_rad};
}

/// The flank above an apron.
struct Heap {
  const char* name;
  FlankLaw law;
  double grain;
  double bumps = 0;  ///< amplitude of the edge's bumps / grain

  double flank(double u) const { return u < kLength ? kHeight * law.height(u / kLength) : 0; }
  double place(double height) const { return kLength * law.out_at(height / kHeight); }
  double bump(double u) const {
    return bumps * grain * std::sin(2 * std::numbers::pi * u / (1.4 * grain));
  }
};

std::ostream& operator<<(std::ostream& out, const Heap& heap) { return out << heap.name; }

/// A heap's edge with a foot, one property of which is changed step by step.
using Foot = std::function<double(const Heap& heap, double changed, double u)>;

void expect_no_leap(const Heap& heap, double from, double to, int steps, const Foot& foot) {
  constexpr double kLargest_rad = 0.3 * kDegree;
  double last_rad = 0;
  double last_interval_rad = 0;
  for (int i = 0; i <= steps; ++i) {
    const double changed = from + (to - from) * i / steps;
    const Measured now =
        measured_flank([&](double u) { return foot(heap, changed, u); }, heap.grain);
    ASSERT_EQ(now.fit.status, FlankStatus::ok) << changed;
    EXPECT_LE(now.fit.apron_rad, now.interval_rad) << "both readings lie in the interval";
    if (i > 0) {
      const double widening = std::abs(now.interval_rad - last_interval_rad);
      EXPECT_LE(std::abs(now.fit.angle_rad - last_rad), widening + kLargest_rad) << changed;
    }
    last_rad = now.fit.angle_rad;
    last_interval_rad = now.interval_rad;
  }
}

class ApronSteps : public ::testing::TestWithParam<Heap> {};

TEST_P(ApronSteps, OfALevelApronsThicknessMoveNoLine) {
  expect_no_leap(GetParam(), 0.04, 0.36, 32, [](const Heap& heap, double thick, double u) {
    return u < 2.5 * kLength ? std::max(heap.flank(u), thick * kHeight) + heap.bump(u) : 0;
  });
}

TEST_P(ApronSteps, OfItsLengthMoveNoLine) {
  expect_no_leap(GetParam(), 0, 1.2, 80, [](const Heap& heap, double length, double u) {
    const double apron = u < kLength * (.8 + length) ? .24 * kHeight : 0;
    const double here = std::max(heap.flank(u), apron);
    return here > 0 ? here + heap.bump(u) : 0;
  });
}

TEST_P(ApronSteps, OfItsSlopeMoveNoLine) {
  expect_no_leap(GetParam(), .02, 1, 70, [](const Heap& heap, double slope, double u) {
    const double from = heap.place(.3 * kHeight);
    if (u < from) return heap.flank(u) + heap.bump(u);
    const double here = .3 * kHeight - slope * kSlope * (u - from);
    return here > 0 ? here + heap.bump(u) : 0;
  });
}

TEST_P(ApronSteps, OfTheHeightFromWhichItRunsOutMoveNoLine) {
  expect_no_leap(GetParam(), .08, .4, 80, [](const Heap& heap, double begins, double u) {
    const double from = heap.place(begins * kHeight);
    if (u < from) return heap.flank(u) + heap.bump(u);
    const double here = begins * kHeight * (1 - (u - from) / (1.2 * kLength));
    return here > 0 ? here + heap.bump(u) : 0;
  });
}

TEST_P(ApronSteps, OfASecondLayerMoveNoLine) {
  expect_no_leap(GetParam(), 0, .6, 80, [](const Heap& heap, double length, double u) {
    const double upper = u < kLength * (.75 + length) ? .27 * kHeight : 0;
    const double lower = u < 2 * kLength ? .14 * kHeight : 0;
    const double here = std::max({heap.flank(u), upper, lower});
    return here > 0 ? here + heap.bump(u) : 0;
  });
}

INSTANTIATE_TEST_SUITE_P(Heaps, ApronSteps,
                         ::testing::Values(Heap{"straight", FlankLaw(Flanks::straight, 1), 4},
                                           Heap{"straight_of_few_grains",
                                                FlankLaw(Flanks::straight, 1), 11, .2},
                                           Heap{"power", FlankLaw(Flanks::power, 1.5), 4, .2},
                                           Heap{"exponential_of_few_grains",
                                                FlankLaw(Flanks::exponential, 1.5), 11, .2}),
                         [](const auto& tested) { return std::string(tested.param.name); });

/// The rough edge of a heap nine grains high, with an apron of about two grains, of random length
/// and thickness.
std::vector<double> repeat(Random& random, bool has_apron) {
  constexpr double kGrain = 12;
  constexpr int kBump = 8;  // correlated columns
  const double thick = has_apron ? kGrain * 2.2 * (1 + random.normal(0, .15)) : 0;
  const double end = kLength * (1 + random.uniform(.2, 1.2));
  std::vector<double> white;
  for (int i = 0; i < 1200; ++i) white.push_back(random.normal(0, .2 * kGrain));
  std::vector<double> edge;
  for (std::size_t i = 0; i + kBump < white.size() && static_cast<double>(i) < end; ++i) {
    double bump = 0;
    for (std::size_t k = 0; k < kBump; ++k) bump += white[i + k] / std::sqrt(kBump);
    const double u = static_cast<double>(i) + .5;
    const double flank = u < kLength ? kHeight * std::pow(1 - u / kLength, 1.3) : 0;
    const double foot = std::max(flank, thick);
    if (foot <= 0) break;
    edge.push_back(std::max(1.0, foot + bump));
  }
  return edge;
}

struct Repeats {
  double mean_rad = 0;
  double deviation_rad = 0;
  int with_both_readings = 0;  ///< with both in the interval
};

Repeats repeats(bool has_apron, int count) {
  Random random(7);
  std::vector<double> angles;
  Repeats all;
  for (int i = 0; i < count; ++i) {
    const std::vector<double> edge = repeat(random, has_apron);
    const Measured one = measured_flank(
        [&](double u) {
          const auto at = static_cast<std::size_t>(u);
          return at < edge.size() ? edge[at] : 0;
        },
        12);
    angles.push_back(one.fit.angle_rad);
    all.mean_rad += one.fit.angle_rad / count;
    all.with_both_readings += one.fit.apron_rad <= one.interval_rad ? 1 : 0;
  }
  for (const double angle : angles) {
    all.deviation_rad += std::pow(angle - all.mean_rad, 2) / (count - 1);
  }
  all.deviation_rad = std::sqrt(all.deviation_rad);
  return all;
}

TEST(Apron, RepeatsScatterAsMuchAsTheirFlanksDo) {
  // Aprons about a fifth of the height thick. With equal weight for all columns, angles scatter by
  // 6 degrees and more.
  constexpr int kCount = 40;
  const Repeats without = repeats(false, kCount);
  const Repeats with = repeats(true, kCount);
  EXPECT_LT(with.deviation_rad, 1.4 * without.deviation_rad);
  EXPECT_NEAR(with.mean_rad, without.mean_rad, .5 * kDegree);
  EXPECT_EQ(with.with_both_readings, kCount);
}

TEST(Apron, HardlyCountsAndIsDescribed) {
  const double slope = std::tan(26 * kDegree);
  constexpr double kGrain = 12;
  const auto with_apron = [&](double u) {  // two grains thick, twice the flank's length
    const double end = 3 * kHeight / slope;
    return u < end ? std::max(kHeight - slope * u, 2.2 * kGrain + std::sin(u / 4)) : 0;
  };
  const FlankFit fit = measured_flank(with_apron, kGrain).fit;
  EXPECT_NEAR(fit.angle_rad, 26 * kDegree, 0.3 * kDegree);
  ASSERT_TRUE(fit.apron);
  EXPECT_NEAR(fit.apron->from, 2.2 * kGrain / kHeight, 0.03);
  EXPECT_EQ(fit.window_from, fit.apron->from);
  const double knee = (kHeight - 2.2 * kGrain) / slope;
  EXPECT_NEAR(fit.apron->length, 3 * kHeight / slope - knee, 3 * kGrain);
  EXPECT_FALSE(fit.apron->is_high);
  EXPECT_LT(fit.apron->angle_with_rad, 15 * kDegree);
  EXPECT_NEAR(fit.apron_rad, fit.angle_rad - fit.apron->angle_with_rad, 1e-12);
  // The points reported as fitted end where the apron begins.
  EXPECT_NEAR(fit.height[fit.counted() - 1], 2.2 * kGrain, 3);
}

TEST(Apron, BelowTheWindowChangesNothing) {
  const double slope = std::tan(26 * kDegree);
  const auto with_apron = [&](double u) {
    return u < 3 * kHeight / slope ? std::max(kHeight - slope * u, 24 + std::sin(u / 4)) : 0;
  };
  const Profile profile = profile_of(1200, [&](double along) {
    const double u = along - 20.5;
    return u < 0 ? kHeight + 0.5 * u : with_apron(u);
  });
  const FlankFit fit =
      fit_flank(profile, Side::right, {.window_from = 0.4, .window_to = 0.9, .grain = 6});
  EXPECT_FALSE(fit.apron);
  EXPECT_NEAR(fit.height.back(), .4 * kHeight, 1.5);
  EXPECT_NEAR(fit.angle_rad, 26 * kDegree, 0.1 * kDegree);
}

TEST(Apron, FromHighUpIsSaidToBeHigh) {
  // Nearly level below .4 of the height.
  const auto with_foot = [](double u) {
    return u < 600 ? std::max(kHeight - .5 * u, .4 * kHeight - 0.05 * (u - 132)) : 0;
  };
  const FlankFit fit = measured_flank(with_foot, 5).fit;
  ASSERT_TRUE(fit.apron);
  EXPECT_TRUE(fit.apron->is_high);
  EXPECT_NEAR(fit.apron->from, 0.4, 0.03);
}

TEST(Apron, BeforeAWallIsNoHeapsFoot) {
  // The rest of the window without the plate is upright: no line fits it better.
  const auto plate = [](double u) { return u < 8 ? kHeight - 9 * u : u < 300 ? .3 * kHeight : 0; };
  const FlankFit fit = measured_flank(plate, 5).fit;
  EXPECT_EQ(fit.status, FlankStatus::absent);
  EXPECT_TRUE(fit.vertical);
}

TEST(Apron, OrHollowFootOfFewLargeGrainsIsInTheInterval) {
  // Too few grains to distinguish the two: both readings count.
  const auto with_foot = [](double u) {
    return std::max(0.0, u < 78 ? kHeight - 0.7 * u : 55 - 0.25 * (u - 78));
  };
  const Measured foot = measured_flank(with_foot, 22);
  const Profile profile = profile_of(1200, [&](double along) {
    const double u = along - 20.5;
    return u < 0 ? kHeight + 0.5 * u : with_foot(u);
  });
  const double whole_rad =
      fit_flank(profile, Side::right, {.leave_apron_out = false, .grain = 22}).angle_rad;
  EXPECT_GE(foot.fit.angle_rad, whole_rad);
  EXPECT_LE(foot.fit.angle_rad, std::atan(.7));
  EXPECT_LE(foot.fit.angle_rad - foot.interval_rad, whole_rad);
}

TEST(Apron, CountsInFullWhereThatIsAskedFor) {
  const Profile profile = profile_of(900, [](double along) {
    const double u = along - 20.5;
    return u < 0 ? kHeight + 0.5 * u : std::max(kHeight - kSlope * u, u < 600 ? 26.0 : 0);
  });
  const FlankOptions options{.leave_apron_out = false, .grain = 6};
  const FlankFit with = fit_flank(profile, Side::right, options);
  EXPECT_FALSE(with.apron);
  EXPECT_EQ(with.apron_rad, 0);
  EXPECT_EQ(with.counted(), with.along.size());
  const FlankFit without = fit_flank(profile, Side::right, {.grain = 6});
  EXPECT_NEAR(without.apron->angle_with_rad, with.angle_rad, 1e-12);
}

}  // namespace
}  // namespace repose::vision
