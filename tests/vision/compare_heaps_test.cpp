#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "tests/vision/measured_triangles.h"
#include "vision/compare/heap_comparison.h"

namespace repose::vision {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

CompareOptions scaled(double first_m_per_px, double second_m_per_px) {
  CompareOptions options;
  options.scale = {PictureScale{.length_m = first_m_per_px},
                   PictureScale{.length_m = second_m_per_px}};
  return options;
}

HeapComparison compare(const TriangleHeap& first, const TriangleHeap& second,
                       const CompareOptions& options = {}) {
  return compare_heaps(measured(first), measured(second), options);
}

bool warns(const HeapComparison& comparison, const std::string& code) {
  return std::any_of(comparison.warnings.begin(), comparison.warnings.end(),
                     [&](const CompareWarning& warning) { return warning.warning.code == code; });
}

TEST(CompareHeaps, AHeapWithItselfIsAllTheSame) {
  CompareOptions options = scaled(1e-3, 1e-3);
  options.same_measurement = true;
  const HeapComparison same = compare({}, {}, options);
  EXPECT_EQ(same.status, MeasureStatus::ok);
  EXPECT_EQ(same.iou, 1);
  EXPECT_EQ(same.profile_rmse, 0);
  EXPECT_EQ(same.best_shift, 0);
  EXPECT_NEAR(*same.hausdorff, 0, kExact);
  EXPECT_EQ(same.angle->interval_rad[0], 0);
  EXPECT_EQ(same.angle->verdict, Agreement::equivalent);
  EXPECT_TRUE(warns(same, "same_picture"));
}

TEST(CompareHeaps, TrianglesOnOneBaseHaveTheExactNumbers) {
  // Heights 1 and 1/2 of h = .15 m: IoU 1/2, difference h/2 (1 - |x|), so mean h/4, square h^2/12.
  const HeapComparison c = compare({}, {.height = 75}, scaled(1e-3, 1e-3));
  EXPECT_EQ(c.unit, LengthUnit::metre);
  EXPECT_NEAR(*c.iou, 0.5, kExact);
  EXPECT_NEAR(*c.profile_mean, 0.15 / 4, kExact);
  EXPECT_NEAR(*c.profile_rmse, 0.15 / std::sqrt(12), kExact);
  for (const SideComparison& side : {c.left, c.right}) {
    EXPECT_EQ(side.cover, Coverage::whole);
    EXPECT_NEAR(*side.iou, 0.5, kExact);
    EXPECT_NEAR(*side.profile_mean, 0.15 / 4, kExact);
    EXPECT_NEAR(*side.profile_rmse, 0.15 / std::sqrt(12), kExact);
  }
  EXPECT_NEAR(*c.hausdorff, 0.075, kExact) << "from tip to tip";
  EXPECT_NEAR(*c.height[0] - *c.height[1], 0.075, kExact);
  EXPECT_NEAR(*c.base[0], 0.6, kExact);
  EXPECT_NEAR(*c.angle_rad[0] - *c.angle_rad[1], std::atan(0.5) - std::atan(0.25), kExact);
  EXPECT_EQ(c.angle->verdict, Agreement::different);
}

TEST(CompareHeaps, PlaceRollAndResolutionDoNotMatter) {
  for (const TriangleHeap& other :
       {TriangleHeap{.tip_x = 900, .ground_y = 200}, TriangleHeap{.tilt_rad = 0.07},
        TriangleHeap{.tilt_rad = -0.07, .step = 7}}) {
    const HeapComparison c = compare({}, other, scaled(1e-3, 1e-3));
    EXPECT_NEAR(*c.iou, 1, kExact);
    EXPECT_NEAR(*c.profile_rmse, 0, kExact);
    EXPECT_NEAR(*c.best_shift, 0, 1e-5);
  }
}

TEST(CompareHeaps, ScalesOfEachPictureAreUsed) {
  const TriangleHeap twice{.left_base = 600, .right_base = 600, .height = 300};
  const HeapComparison c = compare({}, twice, scaled(1e-3, 0.5e-3));
  EXPECT_NEAR(*c.iou, 1, kExact);
  EXPECT_NEAR(*c.base[1], 0.6, kExact);
  EXPECT_NEAR(*compare({}, twice, scaled(1e-3, 1e-3)).iou, 0.25, kExact);
}

TEST(CompareHeaps, AKnownBaseIsAScale) {
  CompareOptions options;
  options.scale[0] = PictureScale{.from = PictureScale::From::base, .length_m = 0.3};
  options.scale[1] = PictureScale{.from = PictureScale::From::base, .length_m = 0.3};
  const HeapComparison c =
      compare({}, {.left_base = 100, .right_base = 100, .height = 50}, options);
  EXPECT_EQ(c.unit, LengthUnit::metre);
  EXPECT_NEAR(*c.height[0], 0.075, kExact);
  EXPECT_NEAR(*c.iou, 1, kExact);

  const HeapComparison unseen = compare({.has_left = false}, {}, options);
  EXPECT_EQ(unseen.unit, LengthUnit::root_area);
  EXPECT_TRUE(warns(unseen, "base_not_seen"));
}

TEST(CompareHeaps, WithoutAScaleOnlyShapesAreCompared) {
  const HeapComparison larger =
      compare({}, {.left_base = 30, .right_base = 30, .height = 15, .step = 0.5});
  EXPECT_EQ(larger.unit, LengthUnit::root_area);
  EXPECT_NEAR(*larger.iou, 1, kExact);
  EXPECT_FALSE(larger.profile_mean) << "equal areas make it 0";
  EXPECT_TRUE(warns(larger, "no_scale"));
  // sqrt(area) = sqrt(300 * 150)
  EXPECT_NEAR(*larger.height[0], 150 / std::sqrt(300 * 150), kExact);

  // Scaled to equal areas, slopes 1/2 and 1/8 cross: IoU 1/2 as for half the base and twice the
  // height.
  EXPECT_NEAR(*compare({}, {.height = 37.5}).iou, 0.5, kExact);
}

TEST(CompareHeaps, MirroredHeapsSwapSides) {
  const TriangleHeap leaning{.left_base = 200, .right_base = 400};
  const TriangleHeap mirrored{.left_base = 400, .right_base = 200};
  const HeapComparison c = compare(leaning, mirrored, scaled(1e-3, 1e-3));
  EXPECT_NEAR(c.angle->difference_rad, 0, kExact);
  EXPECT_EQ(c.angle->verdict, Agreement::equivalent);
  EXPECT_TRUE(warns(c, "sides_differ"));
  EXPECT_LT(*c.iou, 1);
  EXPECT_NEAR(*c.left.iou, *c.right.iou, kExact);
  EXPECT_NEAR(*c.left.profile_mean, -*c.right.profile_mean, kExact);
  EXPECT_NEAR(c.left.angle->difference_rad, -c.right.angle->difference_rad, kExact);
  EXPECT_NEAR(*c.left.run_out[0], *c.right.run_out[1], kExact);
}

TEST(CompareHeaps, SwappedHeapsGiveTheSameWithTheOtherSign) {
  const TriangleHeap one{.left_base = 260}, other{.height = 130};
  const HeapComparison there = compare(one, other), back = compare(other, one);
  EXPECT_NEAR(*there.iou, *back.iou, kExact);
  EXPECT_NEAR(*there.profile_rmse, *back.profile_rmse, kExact);
  EXPECT_NEAR(*there.left.profile_mean, -*back.left.profile_mean, kExact);
  EXPECT_NEAR(*there.hausdorff, *back.hausdorff, kExact);
  EXPECT_NEAR(*there.best_shift, -*back.best_shift, 1e-3);
}

TEST(CompareHeaps, BestShiftFindsWhatTheAlignmentMisses) {
  // Against a wall the crests are aligned; here the second one is placed 20 px beside its tip.
  ReposeAngle second = measured({.has_right = false});
  second.crest->x -= 20;
  const HeapComparison c =
      compare_heaps(measured({.has_right = false}), second, scaled(1e-3, 1e-3));
  EXPECT_TRUE(c.is_aligned_by_crest);
  EXPECT_NEAR(*c.best_shift, -0.02, 1e-4);
  EXPECT_LT(*c.best_shift_rmse, 0.1 * *c.profile_rmse);
}

/// With large grains a heap ends in upright faces: here at both feet, a third of the height high.
ReposeAngle blunt_heap() {
  const TriangleHeap whole;
  ReposeAngle heap = measured(whole);
  std::erase_if(heap.upper_edge,
                [&](const Point& point) { return whole.ground_y - point.y < whole.height / 3; });
  return heap;
}

TEST(CompareHeaps, UprightEndsStillHaveAnAxis) {
  ReposeAngle second = blunt_heap();
  second.crest->x -= 20;
  const HeapComparison c = compare_heaps(blunt_heap(), second, scaled(1e-3, 1e-3));
  EXPECT_FALSE(c.is_aligned_by_crest);
  EXPECT_NEAR(*c.iou, 1, kExact);
}

TEST(CompareHeaps, AFootBeyondTheFrameLeavesNoAxis) {
  ReposeAngle cut = blunt_heap();
  cut.right.leaves_frame = true;
  EXPECT_TRUE(compare_heaps(cut, measured({})).is_aligned_by_crest);
}

TEST(CompareHeaps, AMissingFlankLeavesTheOtherSide) {
  const HeapComparison c = compare({.has_right = false}, {.right_base = 900}, scaled(1e-3, 1e-3));
  EXPECT_EQ(c.status, MeasureStatus::ok);
  EXPECT_TRUE(c.is_aligned_by_crest);
  EXPECT_EQ(c.right.cover, Coverage::none);
  EXPECT_FALSE(c.right.iou);
  EXPECT_FALSE(c.right.angle);
  EXPECT_NEAR(*c.iou, 1, kExact) << "of the left sides, which are equal";
  EXPECT_NEAR(c.angle->difference_rad, 0, kExact) << "of the left sides too";
  EXPECT_FALSE(c.base[0]);
  EXPECT_TRUE(c.base[1]);
  EXPECT_TRUE(warns(c, "side_not_compared"));
  EXPECT_TRUE(warns(c, "one_side"));
}

TEST(CompareHeaps, OppositeFlanksCompareAnglesOnly) {
  const HeapComparison c = compare({.has_right = false}, {.has_left = false});
  EXPECT_FALSE(c.iou);
  EXPECT_FALSE(c.profile_rmse);
  EXPECT_FALSE(c.hausdorff);
  EXPECT_NEAR(c.angle->difference_rad, 0, kExact);
  EXPECT_TRUE(warns(c, "unlike_sides"));
}

TEST(CompareHeaps, ASideCutByTheFrameIsComparedAsFarAsItIsSeen) {
  const HeapComparison c = compare({.cut_left = 200}, {}, scaled(1e-3, 1e-3));
  EXPECT_EQ(c.left.cover, Coverage::part);
  EXPECT_EQ(c.right.cover, Coverage::whole);
  EXPECT_NEAR(*c.iou, 1, kExact) << "what is out of the frame is no difference";
  EXPECT_FALSE(c.left.angle);
  EXPECT_FALSE(c.left.run_out[0]);
  EXPECT_FALSE(c.base[0]);
  EXPECT_TRUE(warns(c, "side_cut"));
  const TriangleHeap half{.left_base = 150, .right_base = 150, .height = 75};
  const HeapComparison unscaled = compare({.cut_left = 200}, half);
  EXPECT_EQ(unscaled.unit, LengthUnit::height);
  EXPECT_NEAR(*unscaled.iou, 1, kExact);
}

TEST(CompareHeaps, ARefusedPictureIsRefusedWithItsReason) {
  ReposeAngle nothing;
  nothing.reason = "no heap stands out.";
  const HeapComparison c = compare_heaps(measured({}), nothing);
  EXPECT_EQ(c.status, MeasureStatus::refused);
  EXPECT_THAT(c.reason, HasSubstr("second picture: no heap stands out."));
  EXPECT_FALSE(c.iou);
  EXPECT_FALSE(c.angle);
  EXPECT_THAT(c.outlines[0], IsEmpty());
  EXPECT_THAT(compare_heaps(nothing, nothing).reason, HasSubstr("first picture: no heap"));
}

/// A heap with only its angle refused.
ReposeAngle without_angle(const TriangleHeap& heap) {
  ReposeAngle result = measured(heap);
  result.status = MeasureStatus::refused;
  result.reason = "the left side is round.";
  result.outline_valid = true;
  result.angle_rad.reset();
  result.uncertainty_rad.reset();
  result.left.angle_rad.reset();
  result.right.angle_rad.reset();
  return result;
}

TEST(CompareHeaps, OutlinesAreComparedWhereOnlyAnAngleIsRefused) {
  const HeapComparison c = compare_heaps(measured({}), without_angle({}), scaled(1e-3, 1e-3));
  EXPECT_EQ(c.status, MeasureStatus::flagged);
  EXPECT_NEAR(*c.iou, 1, kExact);
  EXPECT_TRUE(c.left.run_out[1]);
  EXPECT_FALSE(c.angle);
  EXPECT_TRUE(c.angle_rad[0]);
  EXPECT_FALSE(c.angle_rad[1]);
  ASSERT_TRUE(warns(c, "angle_refused"));
  EXPECT_THAT(c.warnings[0].warning.message, HasSubstr("the left side is round."));
  EXPECT_EQ(c.warnings[0].picture, 1);
  const HeapComparison one_sided =
      compare_heaps(without_angle({.has_left = false}), measured({}), scaled(1e-3, 1e-3));
  EXPECT_FALSE(one_sided.angle);
  EXPECT_EQ(one_sided.right.cover, Coverage::whole);
}

TEST(CompareHeaps, PicturesBringTheirWarningsAndFlags) {
  ReposeAngle flagged = measured({});
  flagged.status = MeasureStatus::flagged;
  flagged.warnings = {{"weak_edge", "The heap's edge is uncertain."}};
  const HeapComparison c = compare_heaps(measured({}), flagged, scaled(1e-3, 1e-3));
  EXPECT_EQ(c.status, MeasureStatus::flagged);
  ASSERT_THAT(c.warnings, SizeIs(1));
  EXPECT_EQ(c.warnings[0].picture, 1);
  EXPECT_EQ(c.warnings[0].warning.code, "weak_edge");
}

TEST(CompareHeaps, AnglesByUnlikeDefinitionsAreSaid) {
  ReposeAngle other = measured({});
  other.window = {0.1, 0.9};
  EXPECT_TRUE(warns(compare_heaps(measured({}), other), "unlike_definitions"));
}

TEST(CompareHeaps, LeapsOnATiltedGroundDoNotRunBackwards) {
  ReposeAngle wall = measured({.tilt_rad = 0.14});
  Point leap = wall.upper_edge.back();  // an upright face above the right foot
  leap.y -= 100;
  wall.upper_edge.insert(wall.upper_edge.end() - 1, leap);
  const HeapComparison c = compare_heaps(wall, measured({}), scaled(1e-3, 1e-3));
  EXPECT_TRUE(std::isfinite(*c.profile_rmse));
  for (std::size_t i = 1; i < c.outlines[0].size(); ++i) {
    EXPECT_GT(c.outlines[0][i].along, c.outlines[0][i - 1].along);
  }
}

TEST(CompareOptions, AllErrorsAreNamed) {
  CompareOptions options;
  options.margin_rad = -1;
  options.scale[1] = PictureScale{.length_m = std::numeric_limits<double>::infinity()};
  EXPECT_THAT(options.problems(), SizeIs(3));
  EXPECT_THROW(compare_heaps(measured({}), measured({}), options), base::InputError);
  options = {};
  options.margin_rad = std::nan("");
  ASSERT_THAT(options.problems(), SizeIs(1));
  EXPECT_THAT(options.problems()[0].text(), HasSubstr("Fix: "));
  EXPECT_THAT(CompareOptions{}.problems(), IsEmpty());
}

}  // namespace
}  // namespace repose::vision
