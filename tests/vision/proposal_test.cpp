#include "vision/hints/proposal.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/support/places.h"
#include "tests/vision/pictures.h"

namespace repose::vision {
namespace {

TEST(Proposal, ATimerBeforeTheHeapMayBeLeftOut) {
  const auto heap = drawn("clean", 2, 800);
  cv::Mat3b picture = mat_of(heap.picture).clone();
  // A lettered plate at the crest joins the heap.
  const int crest_x = static_cast<int>((heap.ground.from.x + heap.ground.to.x) / 2);
  const int crest_y = static_cast<int>(heap.ground.from.y - heap.height_px);
  const cv::Rect plate(crest_x - 60, crest_y - 30, 120, 44);
  picture(plate).setTo(cv::Vec3b(10, 10, 10));
  cv::putText(picture, "00:01.0", plate.tl() + cv::Point(4, 30), cv::FONT_HERSHEY_DUPLEX, 0.9,
              cv::Scalar::all(255), 2);
  const Picture covered = picture_of(picture);
  const auto proposal = propose_hint(covered, {});
  ASSERT_TRUE(proposal);
  ASSERT_TRUE(proposal->angle_rad);
  EXPECT_NEAR(*proposal->angle_rad, *heap.mean_rad(), 1.5 * kDegree);
  // Applied, it gives the promised angle.
  MeasureOptions options;
  if (proposal->excluded) options.excluded.push_back(*proposal->excluded);
  options.hints.heap = proposal->heap;
  EXPECT_EQ(measure_repose_angle(covered, options).angle_rad, proposal->angle_rad);
}

TEST(Proposal, ABoxAroundAHeapReachesOverItsCrestEvenIfThatLiesInAShadow) {
  // A rendered heap; its silhouette has this crest and this angle.
  const Picture picture =
      read_picture(testing::source_folder() / "tests/vision/rendered/crest_in_shadow.jpg");
  constexpr int kCrest_y = 158;
  constexpr double kSilhouette_deg = 26.8;
  const auto proposal = propose_hint(picture, {});
  ASSERT_TRUE(proposal);
  ASSERT_TRUE(proposal->heap);
  EXPECT_LT(proposal->heap->y, kCrest_y);
  ASSERT_TRUE(proposal->angle_rad);
  EXPECT_NEAR(*proposal->angle_rad / kDegree, kSilhouette_deg, 2);
}

/// A picture that a turn by `turn_deg` sets upright again.
Picture lying(const Picture& upright, int turn_deg) { return turned(upright, 360 - turn_deg); }

TEST(Proposal, APictureThatLiesOnItsSideIsToBeTurned) {
  const auto heap = drawn("clean", 3, 600);
  const std::optional<double> upright_rad = measure_repose_angle(heap.picture).angle_rad;
  for (const int turn_deg : kTurns_deg) {
    const Picture picture = lying(heap.picture, turn_deg);
    ASSERT_EQ(measure_repose_angle(picture).status, MeasureStatus::refused) << turn_deg;
    const auto proposal = propose_hint(picture, {});
    ASSERT_TRUE(proposal) << turn_deg;
    EXPECT_EQ(proposal->turn_deg, turn_deg);
    EXPECT_EQ(proposal->angle_rad, upright_rad);
    EXPECT_FALSE(proposal->heap);
  }
}

TEST(Proposal, APictureInWhichAPersonHasMarkedSomethingIsNotTurned) {
  MeasureOptions options;
  options.hints.keep = {{300, 200}};
  const auto proposal = propose_hint(lying(drawn("clean", 3, 600).picture, 90), options);
  EXPECT_TRUE(!proposal || proposal->turn_deg == 0);
}

TEST(Proposal, NothingIsProposedWhereNothingIsSeen) {
  EXPECT_FALSE(propose_hint(picture_of(cv::Mat3b(300, 400, cv::Vec3b(90, 90, 90))), {}));
  EXPECT_FALSE(propose_hint(picture_of(cv::Mat3b(1, 1, cv::Vec3b(90, 90, 90))), {}));
  EXPECT_FALSE(propose_hint(picture_of(cv::Mat3b(300, 400, cv::Vec3b())), {}));
}

}  // namespace
}  // namespace repose::vision
