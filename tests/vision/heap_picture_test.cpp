#include "tests/support/heap_picture.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/input_error.h"
#include "tests/support/heap_conditions.h"
#include "tests/support/heap_fit.h"

namespace repose::testing {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

struct Spread {
  double bias_deg = 0;
  double sd_deg = 0;
};

/// Bias and scatter of fitted less true flank angles.
Spread flank_errors(const char* condition, int seeds) {
  std::vector<double> errors;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto heap = heap_truth(condition_named(condition).scene(static_cast<unsigned>(seed)));
    for (const auto error : outline_errors_rad(heap)) errors.push_back(error);
  }
  double sum = 0;
  double squares = 0;
  for (const double error : errors) {
    sum += error * kDegrees;
    squares += error * error * kDegrees * kDegrees;
  }
  const double count = static_cast<double>(errors.size());
  return {sum / count, std::sqrt(squares / count)};
}

class ExactAngles : public ::testing::TestWithParam<const char*> {};

/// The measurements' targets are 0.15 and 0.3 degrees: the truth must be several times better.
TEST_P(ExactAngles, OutlineFollowsTheConstructedFlank) {
  const auto [bias_deg, sd_deg] = flank_errors(GetParam(), 100);
  RecordProperty("bias_deg", std::to_string(bias_deg));
  RecordProperty("sd_deg", std::to_string(sd_deg));
  EXPECT_LT(std::abs(bias_deg), 0.03);
  EXPECT_LT(sd_deg, 0.12);
}

INSTANTIATE_TEST_SUITE_P(Conditions, ExactAngles,
                         ::testing::Values("clean", "asymmetric", "small", "roll", "concave_toe",
                                           "apron", "half_heap", "truncated", "silhouette",
                                           "hazelnut", "few_grains", "hollow_power",
                                           "hollow_exponential", "hollow_half_heap", "hollow_apron",
                                           "few_grains_hollow"));

TEST(HeapPicture, SameSeedGivesTheSameBytes) {
  const auto scene = condition_named("texture").scene(5);
  EXPECT_EQ(draw_heap(scene).picture.bgr, draw_heap(scene).picture.bgr);
}

TEST(HeapPicture, OtherSeedGivesAnotherHeap) {
  const auto one = draw_heap(condition_named("clean").scene(1));
  const auto two = draw_heap(condition_named("clean").scene(2));
  EXPECT_NE(*one.left_rad, *two.left_rad);
  EXPECT_NE(one.picture.bgr, two.picture.bgr);
}

TEST(HeapPicture, EveryConditionDrawsAPictureOfItsSize) {
  for (const auto& condition : conditions()) {
    const auto scene = condition.scene(3);
    const auto heap = draw_heap(scene);
    EXPECT_EQ(heap.picture.width, scene.width) << condition.name;
    EXPECT_EQ(heap.picture.bgr.size(), 3U * static_cast<unsigned>(scene.width * scene.height));
    EXPECT_EQ(heap.mean_rad().has_value(), condition.group != Group::not_measurable)
        << condition.name;
  }
}

TEST(HeapPicture, HalfHeapsAndTruncatedHeapsHaveOneFlank) {
  for (const char* name : {"half_heap", "truncated"}) {
    const auto heap = draw_heap(condition_named(name).scene(1));
    EXPECT_NE(heap.left_rad.has_value(), heap.right_rad.has_value()) << name;
  }
}

TEST(HeapPicture, GroundTiltIsTheSlopeOfTheGroundLine) {
  const auto heap = heap_truth(condition_named("roll").scene(4));
  const auto& [from, to] = heap.ground;
  EXPECT_NEAR(std::atan2(to.y - from.y, to.x - from.x), heap.ground_tilt_rad, 1e-12);
}

TEST(HeapPicture, SilhouetteIsBlackBelowTheFlankAndWhiteAbove) {
  const auto heap = draw_heap(condition_named("silhouette").scene(2));
  const vision::Segment line = *heap.left_line;
  const vision::Point middle = {(line.from.x + line.to.x) / 2, (line.from.y + line.to.y) / 2};
  const auto blue_at = [&](double x, double y) {
    return heap.picture
        .bgr[3 * (static_cast<std::size_t>(y) * static_cast<unsigned>(heap.picture.width) +
                  static_cast<std::size_t>(x))];
  };
  EXPECT_EQ(blue_at(middle.x, middle.y - 3), 255);
  EXPECT_EQ(blue_at(middle.x, middle.y + heap.grain_px), 0);
}

TEST(HeapConditions, UnknownNameSaysHowToFindTheNames) {
  EXPECT_THROW(condition_named("fog"), std::invalid_argument);
}

}  // namespace
}  // namespace repose::testing
