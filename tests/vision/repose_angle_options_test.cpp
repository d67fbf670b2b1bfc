#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

#include "base/input_error.h"
#include "tests/support/texts_of.h"
#include "tests/vision/pictures.h"
#include "vision/measure/camera_pitch.h"
#include "vision/measure/repose_angle.h"

/// The effects of a measurement's options, and which are refused.
namespace repose::vision {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

MeasureOptions window(double from, double to) {
  MeasureOptions options;
  options.window_from = from;
  options.window_to = to;
  return options;
}

TEST(MeasureOptions, DefaultsHaveNoProblem) {
  EXPECT_THAT(MeasureOptions{}.problems(), IsEmpty());
  EXPECT_THAT(window(0, 1).problems(), IsEmpty());
}

TEST(MeasureOptions, TellsAllProblemsAtOnce) {
  MeasureOptions options = window(0.8, 0.2);
  options.camera_pitch_rad = 2;
  EXPECT_THAT(texts_of(options.problems()),
              ElementsAre(AllOf(HasSubstr("window = 0.8,0.2"), HasSubstr("Fix: ")),
                          AllOf(HasSubstr("pitch = 114.6"), HasSubstr("Fix: "))));
}

TEST(MeasureOptions, WindowsMustBeRisingFractions) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [from, to] : {std::pair(-0.1, 0.5),
                                 {0.2, 1.1},
                                 {0.5, 0.5},
                                 {0.5, 0.55},
                                 {kNan, 0.8},
                                 {0.2, kNan},
                                 {kNan, kNan},
                                 {20., 80.}}) {
    EXPECT_THAT(window(from, to).problems(), SizeIs(1)) << from << ' ' << to;
  }
}

TEST(MeasureOptions, PitchMustBeANumberUpTo30Degrees) {
  for (const double pitch_rad : {std::numeric_limits<double>::quiet_NaN(), 31 * kDegree,
                                 -31 * kDegree, std::numeric_limits<double>::infinity()}) {
    MeasureOptions options;
    options.camera_pitch_rad = pitch_rad;
    EXPECT_THAT(options.problems(), SizeIs(1)) << pitch_rad;
  }
}

/// The exception's message; empty if there is none.
std::string refusal_of(const Picture& picture, const MeasureOptions& options) {
  try {
    measure_repose_angle(picture, options);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(MeasureReposeAngle, ThrowsForBadOptionsAndEmptyPictures) {
  EXPECT_THAT(refusal_of(blank_picture(100, 100), window(0.8, 0.2)), HasSubstr("window = "));
  EXPECT_THAT(refusal_of({}, {}), AllOf(HasSubstr("empty"), HasSubstr("Fix: ")));
  EXPECT_THAT(refusal_of({}, window(0.8, 0.2)), AllOf(HasSubstr("empty"), HasSubstr("window = ")));
}

TEST(MeasureReposeAngle, ThrowsForABoxOutsideThePicture) {
  for (const Box& box :
       {Box{90, 0, 20, 10}, Box{0, 95, 10, 10}, Box{-1, 0, 10, 10}, Box{0, -1, 10, 10},
        Box{0, 0, 0, 10}, Box{0, 0, 10, -5}, Box{100, 100, 1, 1}}) {
    MeasureOptions options;
    options.excluded = {{0, 0, 100, 100}, box};  // the first one is fine
    const std::string given = std::to_string(box.x) + ',' + std::to_string(box.y) + ',' +
                              std::to_string(box.width) + ',' + std::to_string(box.height);
    EXPECT_THAT(refusal_of(blank_picture(100, 100), options),
                AllOf(HasSubstr("excluded box = " + given), HasSubstr("Fix: ")));
  }
}

TEST(MeasureReposeAngle, ThrowsForABoxWhoseEndOverflows) {
  constexpr int kHuge = std::numeric_limits<int>::max();
  MeasureOptions options;
  options.excluded = {{10, 10, kHuge, kHuge}};
  EXPECT_THAT(refusal_of(blank_picture(100, 100), options), HasSubstr("excluded box"));
}

TEST(MeasureReposeAngle, FitsTheWindowThatIsAskedFor) {
  const auto heap = drawn("concave_toe", 1, kUsualWidth);
  const ReposeAngle usual = measure_repose_angle(heap.picture);
  const ReposeAngle upper = measure_repose_angle(heap.picture, window(0.5, 0.9));
  EXPECT_THAT(upper.window, ElementsAre(0.5, 0.9));
  EXPECT_NEAR(static_cast<double>(upper.left.points) / usual.left.points, 4. / 6, 0.15);
  // The lowest edge point lies halfway up, give or take two grains.
  const double base_y = (heap.ground.from.y + heap.ground.to.y) / 2;
  const Point lowest = *std::max_element(upper.left.edge.begin(), upper.left.edge.end(),
                                         [](Point a, Point b) { return a.y < b.y; });
  EXPECT_NEAR(base_y - lowest.y, 0.5 * *upper.height_px, 2 * heap.grain_px);
}

TEST(MeasureReposeAngle, LowWindowsLetTheToeIn) {
  const auto heap = drawn("concave_toe", 1, kUsualWidth);
  MeasureOptions low = window(0.0, 0.4);
  low.method = Method::paper;  // it does not exclude aprons
  const auto silhouette = drawn("silhouette", 1, kUsualWidth);
  EXPECT_LT(deg(measure_repose_angle(heap.picture, window(0.02, 0.5)).angle_rad),
            deg(measure_repose_angle(heap.picture).angle_rad));
  EXPECT_NEAR(deg(measure_repose_angle(silhouette.picture, low).angle_rad),
              deg(silhouette.mean_rad()), 2);
}

TEST(MeasureReposeAngle, AnExcludedThingDoesNotMatter) {
  for (const char* condition : {"clean", "inverted_white"}) {
    const auto heap = drawn(condition, 2, kUsualWidth);
    const ReposeAngle plain = measure_repose_angle(heap.picture);
    // A banner of the heap's own colour over the upper part of the backdrop.
    cv::Mat covered = mat_of(heap.picture).clone();
    const Point crest = heap.left_line->to;
    const cv::Rect below_crest(static_cast<int>(crest.x), static_cast<int>(crest.y) + 20, 30, 15);
    const cv::Rect banner(0, 0, covered.cols, covered.rows * 3 / 10);
    covered(banner).setTo(cv::mean(covered(below_crest)));
    EXPECT_EQ(measure_repose_angle(picture_of(covered)).status, MeasureStatus::refused)
        << "the banner must matter";
    MeasureOptions options;
    options.excluded = {{banner.x, banner.y, banner.width, banner.height}};
    const ReposeAngle result = measure_repose_angle(picture_of(covered), options);
    EXPECT_EQ(result.status, MeasureStatus::ok) << result.reason;
    EXPECT_NEAR(deg(result.angle_rad), deg(plain.angle_rad), 0.3);  // another segmentation may win
  }
}

TEST(MeasureReposeAngle, ABoxOverPartOfAFlankLeavesTheRestToBeMeasured) {
  const auto heap = drawn("clean", 2, kUsualWidth);
  const Segment flank = *heap.left_line;
  const Point middle{(flank.from.x + flank.to.x) / 2, (flank.from.y + flank.to.y) / 2};
  const Box box{static_cast<int>(middle.x) - 15, static_cast<int>(middle.y) - 15, 30, 30};
  cv::Mat covered = mat_of(heap.picture).clone();
  covered(cv::Rect(box.x, box.y, box.width, box.height)).setTo(cv::Scalar(60, 220, 60));
  MeasureOptions options;
  options.excluded = {box};
  const ReposeAngle result = measure_repose_angle(picture_of(covered), options);
  EXPECT_NEAR(deg(result.left.angle_rad), deg(heap.left_rad), 0.5);
  for (const Point& p : result.left.edge) EXPECT_GT(std::abs(p.x - middle.x), 14);
}

TEST(MeasureReposeAngle, PitchIsTakenOutByTheFormula) {
  const auto heap = drawn("clean", 2, kUsualWidth);
  const ReposeAngle level = measure_repose_angle(heap.picture);
  MeasureOptions options;
  options.camera_pitch_rad = 9 * kDegree;
  const ReposeAngle pitched = measure_repose_angle(heap.picture, options);
  const auto corrected = [&](double angle) { return angle_without_pitch(angle, 9 * kDegree); };
  EXPECT_DOUBLE_EQ(*pitched.left.angle_rad, corrected(*level.left.angle_rad));
  EXPECT_DOUBLE_EQ(*pitched.right.angle_rad, corrected(*level.right.angle_rad));
  EXPECT_NEAR(deg(pitched.angle_rad), deg(corrected(*level.angle_rad)), 0.01);
  EXPECT_GT(deg(pitched.angle_rad), deg(level.angle_rad) + 0.5);
}

ReposeAngle measured_with_pitch(const Picture& picture, double pitch_rad) {
  MeasureOptions options;
  options.camera_pitch_rad = pitch_rad;
  return measure_repose_angle(picture, options);
}

TEST(MeasureReposeAngle, ThePitchsIntervalAllowsForANearCamera) {
  const auto heap = drawn("clean", 2, kUsualWidth);
  const ReposeAngle level = measured_with_pitch(heap.picture, 0);
  const ReposeAngle pitched = measured_with_pitch(heap.picture, 9 * kDegree);
  const double rise = (heap.picture.height / 2. - level.crest->y) / (*level.base_px / 2);
  const auto widened = [&](double angle, double own) {
    return std::hypot(own, far_camera_error(angle, 9 * kDegree, rise));
  };
  ASSERT_GT(std::abs(rise), 0.02);
  EXPECT_GT(*pitched.uncertainty_rad, 1.01 * *level.uncertainty_rad);
  EXPECT_NEAR(*pitched.uncertainty_rad, widened(*level.angle_rad, *level.uncertainty_rad), 1e-5);
  EXPECT_NEAR(std::hypot(*pitched.own_uncertainty_rad, *pitched.camera_uncertainty_rad),
              *pitched.uncertainty_rad, 1e-12);
  EXPECT_NEAR(*pitched.own_uncertainty_rad, *level.own_uncertainty_rad, 1e-12);
  EXPECT_NEAR(*pitched.left.uncertainty_rad,
              widened(*level.left.angle_rad, *level.left.uncertainty_rad), 1e-5);
}

TEST(MeasureReposeAngle, AnUntoldPitchsIntervalAllowsForACameraLevelledByEye) {
  const auto heap = drawn("clean", 2, kUsualWidth);  // level with its plate: the base is hidden
  const ReposeAngle told = measured_with_pitch(heap.picture, 0);
  const ReposeAngle untold = measure_repose_angle(heap.picture);
  EXPECT_NEAR(*untold.uncertainty_rad - *told.uncertainty_rad,
              assumed_pitch_error(*told.angle_rad, 2 * kDegree), 1e-6);
  EXPECT_NEAR(*untold.angle_rad, *told.angle_rad, 1e-9);
  EXPECT_NEAR(*untold.camera_uncertainty_rad, assumed_pitch_error(*told.angle_rad, 2 * kDegree),
              1e-6);
  EXPECT_NEAR(*untold.own_uncertainty_rad + *untold.camera_uncertainty_rad, *untold.uncertainty_rad,
              1e-12);
}

/// A dark cone in front of a pale backdrop, seen by a distant camera that looks down.
cv::Mat3b cone_picture(double angle_rad, double pitch_rad) {
  constexpr double kRadius = 220;
  constexpr double kSixteenth = 16;  // of a pixel; OpenCV's pixel centres are whole
  std::vector<cv::Point> points;
  const auto add = [&](double x, double y) {
    points.emplace_back(cvRound((x - 0.5) * kSixteenth), cvRound((y - 0.5) * kSixteenth));
  };
  add(400, 400 - kRadius * std::tan(angle_rad) * std::cos(pitch_rad));
  for (int i = 0; i < 360; ++i) {
    const double around = i * kDegree;
    add(400 + kRadius * std::cos(around), 400 + kRadius * std::sin(pitch_rad) * std::sin(around));
  }
  std::vector<cv::Point> hull;
  cv::convexHull(points, hull);
  cv::Mat3b picture(600, 800, cv::Vec3b(210, 210, 210));
  cv::fillConvexPoly(picture, hull, {80, 90, 100}, cv::LINE_AA, 4);
  return picture;
}

TEST(MeasureReposeAngle, TheIntervalHoldsWhatAnUntoldPitchDoesToABaseThatBows) {
  const double angle = 25 * kDegree;
  for (const double pitch_deg : {0.0, 3.0, 6.0, 9.0}) {
    const ReposeAngle result =
        measure_repose_angle(picture_of(cone_picture(angle, pitch_deg * kDegree)));
    ASSERT_TRUE(result.angle_rad) << result.reason;
    // The ellipse's far half is visible beside the flanks' feet and hides a little of the bow.
    EXPECT_LE(std::abs(*result.angle_rad - angle), 1.1 * *result.uncertainty_rad) << pitch_deg;
    const bool is_said =
        std::any_of(result.warnings.begin(), result.warnings.end(),
                    [](const Warning& warning) { return warning.code == "base_bows"; });
    EXPECT_EQ(is_said, pitch_deg > 5) << pitch_deg;
  }
}

TEST(PaperMethod, GivesTheTruthOfASilhouette) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto heap = drawn("silhouette", seed, kUsualWidth);
    MeasureOptions options;
    options.method = Method::paper;
    const ReposeAngle result = measure_repose_angle(heap.picture, options);
    EXPECT_EQ(result.method, Method::paper);
    // Large grains move a flank at random; the method adds nothing to that.
    EXPECT_NEAR(deg(result.angle_rad), deg(heap.mean_rad()), 0.5) << seed;
    EXPECT_EQ(result.left.angle_rad, result.left.least_squares_rad);
    EXPECT_EQ(deg(result.ground_tilt_rad), 0);
  }
}

TEST(PaperMethod, GivesAnAngleOrARefusalOfAPhoto) {
  MeasureOptions options;
  options.method = Method::paper;
  for (const char* condition : {"clean", "inverted_white", "shadow", "reflection", "half_heap"}) {
    const ReposeAngle result = measure_repose_angle(drawn(condition, 1, 640).picture, options);
    EXPECT_EQ(result.angle_rad.has_value(), result.status != MeasureStatus::refused) << condition;
    EXPECT_EQ(result.angle_rad.has_value(), result.reason.empty()) << condition;
  }
}

bool has_warning(const ReposeAngle& result, const std::string& code) {
  return std::ranges::any_of(result.warnings,
                             [&](const Warning& warning) { return warning.code == code; });
}

TEST(HalfHeap, ItsWallIsNeitherMeasuredNorMissed) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto heap = drawn("half_heap", seed, kUsualWidth);
    const ReposeAngle found = measure_repose_angle(heap.picture);
    MeasureOptions options;
    options.hints.half = heap.left_rad ? Side::left : Side::right;
    const ReposeAngle said = measure_repose_angle(heap.picture, options);
    ASSERT_TRUE(said.angle_rad) << seed << ": " << said.reason;
    EXPECT_EQ(said.angle_rad, found.angle_rad) << seed;
    EXPECT_TRUE(has_warning(found, "one_flank")) << seed;
    EXPECT_FALSE(has_warning(said, "one_flank")) << seed;
    EXPECT_FALSE(has_warning(said, "second_flank")) << seed;
    EXPECT_TRUE(has_warning(said, "hints")) << seed;

    options.hints.half = heap.left_rad ? Side::right : Side::left;
    const ReposeAngle mistaken = measure_repose_angle(heap.picture, options);
    EXPECT_EQ(mistaken.status, MeasureStatus::refused) << seed;
    EXPECT_NE(mistaken.reason.find("said to end at a wall"), std::string::npos) << mistaken.reason;
  }
}

TEST(HalfHeap, AWallThatSlopesLikeAFlankIsFlagged) {
  const auto heap = drawn("clean", 2, kUsualWidth);
  const ReposeAngle whole = measure_repose_angle(heap.picture);
  MeasureOptions options;
  options.hints.half = Side::right;
  const ReposeAngle half = measure_repose_angle(heap.picture, options);
  EXPECT_EQ(half.status, MeasureStatus::flagged);
  EXPECT_TRUE(has_warning(half, "second_flank"));
  EXPECT_EQ(half.left.status, FlankStatus::absent);
  EXPECT_NEAR(deg(half.angle_rad), deg(whole.right.angle_rad), .3);
}

}  // namespace
}  // namespace repose::vision
