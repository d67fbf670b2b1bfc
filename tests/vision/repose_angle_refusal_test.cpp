#include <cmath>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

#include "tests/support/heap_random.h"
#include "tests/vision/pictures.h"
#include "vision/measure/repose_angle.h"

/// Pictures without a heap, or with only part of one: no number rather than a wrong one.
namespace repose::vision {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

void expect_refused(const Picture& picture, const std::string& what) {
  for (const Method method : {Method::automatic, Method::paper}) {
    MeasureOptions options;
    options.method = method;
    const ReposeAngle result = measure_repose_angle(picture, options);
    EXPECT_EQ(result.status, MeasureStatus::refused) << what;
    EXPECT_THAT(result.reason, HasSubstr("Fix: ")) << what;
    EXPECT_FALSE(result.angle_rad || result.uncertainty_rad) << what;
    EXPECT_FALSE(result.left.angle_rad || result.right.angle_rad) << what;
    EXPECT_TRUE(result.confidence >= 0 && result.confidence <= 1) << what;
  }
}

TEST(Refusal, PicturesOfOneColour) {
  for (const int grey : {0, 128, 255}) {
    expect_refused(picture_of(cv::Mat3b(300, 400, cv::Vec3b::all(static_cast<std::uint8_t>(grey)))),
                   "grey " + std::to_string(grey));
  }
  expect_refused(picture_of(cv::Mat3b(300, 400, cv::Vec3b(200, 40, 90))), "violet");
}

TEST(Refusal, RandomNoise) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    testing::Random random(seed);
    Picture picture = blank_picture(400, 300);
    for (std::uint8_t& byte : picture.bgr) {
      byte = static_cast<std::uint8_t>(random.integer(0, 255));
    }
    expect_refused(picture, "noise " + std::to_string(seed));
  }
}

TEST(Refusal, PicturesTooSmallToMeasureIn) {
  for (const auto& [width, height] : {std::pair(1, 1), {63, 63}, {63, 2000}, {2000, 1}}) {
    const ReposeAngle result = measure_repose_angle(blank_picture(width, height));
    EXPECT_THAT(result.reason, HasSubstr(std::to_string(width) + " x " + std::to_string(height)));
    expect_refused(blank_picture(width, height), "small");
  }
}

TEST(Refusal, StripsAreReadWithoutHarm) {
  expect_refused(blank_picture(64, 2000), "upright strip");
  expect_refused(blank_picture(2000, 64), "level strip");
  testing::Random random(1);
  Picture noise = blank_picture(64, 2000);
  for (std::uint8_t& byte : noise.bgr) byte = static_cast<std::uint8_t>(random.integer(0, 255));
  expect_refused(noise, "noisy strip");
}

struct UnfitScene {
  const char* condition;
  const char* says;  ///< part of the reason
};

std::ostream& operator<<(std::ostream& out, const UnfitScene& scene) {
  return out << scene.condition;
}

class NotMeasurable : public ::testing::TestWithParam<UnfitScene> {};

TEST_P(NotMeasurable, IsRefusedAndTheTroubleNamed) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const auto scene = drawn(GetParam().condition, seed, 800);
    expect_refused(scene.picture, std::string(GetParam().condition) + ' ' + std::to_string(seed));
    EXPECT_THAT(measure_repose_angle(scene.picture).reason, HasSubstr(GetParam().says));
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, NotMeasurable,
                         ::testing::Values(UnfitScene{"empty_plate", "no heap"},
                                           UnfitScene{"column", "upright"},
                                           UnfitScene{"ball", "heap"},
                                           UnfitScene{"oblique", "curved base"},
                                           UnfitScene{"wall_to_wall", "no heap"}),
                         [](const auto& p) { return std::string(p.param.condition); });

bool angle_warns(const ReposeAngle& result, const std::string& code) {
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [&](const Warning& warning) { return warning.code == code; });
}

/// The side without a flank, and the other one.
std::pair<Flank, Flank> sides(const testing::DrawnHeap& heap, const ReposeAngle& result) {
  if (heap.left_rad) return {result.right, result.left};
  return {result.left, result.right};
}

TEST(OneFlank, AHalfHeapHasTheOtherSideAbsent) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const auto heap = drawn("half_heap", seed, 800);
    const ReposeAngle result = measure_repose_angle(heap.picture);
    const auto [missing, seen] = sides(heap, result);
    EXPECT_EQ(missing.status, FlankStatus::absent);
    EXPECT_FALSE(missing.angle_rad || missing.uncertainty_rad || missing.line || missing.r2);
    EXPECT_THAT(missing.reason, Not(::testing::IsEmpty()));
    EXPECT_EQ(result.angle_rad, seen.angle_rad);
    EXPECT_EQ(result.uncertainty_rad, seen.uncertainty_rad);
    EXPECT_TRUE(angle_warns(result, "one_flank"));
  }
}

TEST(OneFlank, AFlankOutOfTheFrameIsTruncated) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const auto heap = drawn("truncated", seed, 800);
    const ReposeAngle result = measure_repose_angle(heap.picture);
    const auto [missing, seen] = sides(heap, result);
    EXPECT_EQ(missing.status, FlankStatus::truncated);
    EXPECT_FALSE(missing.angle_rad);
    EXPECT_EQ(result.angle_rad, seen.angle_rad);
    EXPECT_TRUE(angle_warns(result, "flank_truncated"));
  }
}

}  // namespace
}  // namespace repose::vision
