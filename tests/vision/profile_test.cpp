#include "vision/measure/profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

#include "tests/vision/pictures.h"

namespace repose::vision {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Gt;
using ::testing::SizeIs;

constexpr int kEdgeCols = 400;
constexpr int kEdgeRows = 200;
constexpr double kEdgeGround = 180;

/// Everything a profile is read from, made from one upper edge y(x).
struct EdgeScene {
  WorkingPicture work = work_of(cv::Mat3b(kEdgeRows, kEdgeCols, cv::Vec3b(200, 200, 200)));
  Segmentation segmentation{"made", cv::Mat1f(kEdgeRows, kEdgeCols)};
  Body body;

  template <class EdgeY>
  explicit EdgeScene(EdgeY edge_y, PictureLine ground = {kEdgeGround, 0}) {
    static_cast<PictureLine&>(body.ground) = ground;
    body.mask = cv::Mat1b(kEdgeRows, kEdgeCols);
    for (int col = 0; col < kEdgeCols; ++col) {
      const double edge = edge_y(col + 0.5);
      for (int row = 0; row < kEdgeRows; ++row) {
        segmentation.inside(row, col) = static_cast<float>(row + 0.5 - edge);
        body.mask(row, col) = row + 0.5 > edge && row + 0.5 < ground.y(col + 0.5) ? 255 : 0;
      }
    }
  }
  Profile profile() const { return upper_profile(body, segmentation, work); }
};

/// 100 high on the ground line, 30 degrees on both sides.
double heap_y(double x) {
  return kEdgeGround - std::max(0.0, 100 - std::tan(30 * kDegree) * std::abs(x - 200));
}

double height_at(const Profile& profile, double along) {
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (std::abs(profile.along[i] - along) < 0.51) return profile.height[i];
  }
  return -1;
}

/// The heap on a thin layer between two values of x.
Profile with_layer(double height, double from, double to) {
  return EdgeScene([=](double x) {
           return x < from || x > to ? heap_y(x) : std::min(heap_y(x), kEdgeGround - height);
         })
      .profile();
}

TEST(UpperProfile, EndsWhereAStripOfThePlateBegins) {
  const double foot = 100 / std::tan(30 * kDegree);
  for (const auto& [from, to] : {std::pair{0., 200.}, {200., 400.}, {0., 400.}}) {
    const Profile profile = with_layer(1.6, from, to);
    EXPECT_NEAR(profile.along.front(), 200 - foot, 5);
    EXPECT_NEAR(profile.along.back(), 200 + foot, 5);
    EXPECT_FALSE(profile.leaves_frame_left || profile.leaves_frame_right) << "its feet are seen";
    EXPECT_NEAR(profile.crest_height, 100, 3);
    EXPECT_NEAR(profile.along[profile.crest], 200, 1.5);
  }
}

TEST(UpperProfile, KeepsLayersOfGrainsAndToes) {
  EXPECT_NEAR(with_layer(4, 0, 200).along.front(), 0, 1) << "as high as a grain";
  EXPECT_TRUE(with_layer(4, 0, 200).leaves_frame_left);
  EXPECT_NEAR(with_layer(1.6, 22, 200).along.front(), 22, 1) << "as long as a toe";
}

TEST(UpperProfile, OfAStripAloneIsLeftAsItIs) {
  const Profile profile = EdgeScene([](double) { return kEdgeGround - 1.6; }).profile();
  EXPECT_THAT(profile.along, SizeIs(kEdgeCols));
}

TEST(UpperProfile, HasTheEdgesHeightInEveryColumn) {
  const Profile profile = EdgeScene(heap_y).profile();
  ASSERT_GT(profile.size(), 300);
  for (std::size_t i = 0; i < profile.size(); ++i) {
    EXPECT_NEAR(profile.height[i], kEdgeGround - heap_y(profile.along[i]), 1e-4);  // float at 200
  }
  EXPECT_NEAR(profile.along[profile.crest], 200, 1);
  // Smoothing over 9 columns, a fortieth, takes 1.3 off the tip.
  EXPECT_NEAR(profile.crest_height, 100, 1.5);
  EXPECT_FALSE(profile.leaves_frame_left || profile.leaves_frame_right || profile.leaves_frame_top);
}

/// Light blurred over a pixel by the lens, cut at half its step, as in segmentations.
TEST(UpperProfile, FindsABlurredEdgeFinerThanAPixel) {
  for (double fraction = 0; fraction < 1; fraction += 0.1) {
    EdgeScene scene([&](double) { return 90 + fraction; });
    for (int row = 0; row < kEdgeRows; ++row) {
      const double depth = row + 0.5 - (90 + fraction);
      scene.segmentation.inside.row(row) =
          static_cast<float>(std::erf(depth / (0.8 * std::sqrt(2))));
    }
    const Profile profile = scene.profile();
    ASSERT_THAT(profile.height, SizeIs(kEdgeCols));
    EXPECT_THAT(profile.height, Each(::testing::DoubleNear(kEdgeGround - 90 - fraction, 0.05)));
  }
}

TEST(UpperProfile, IsMeasuredFromATiltedGround) {
  const PictureLine ground{150, std::tan(4 * kDegree)};
  // 50 above the ground line, perpendicular to it.
  const EdgeScene scene([&](double x) { return ground.y(x) - 50 / std::cos(4 * kDegree); }, ground);
  EXPECT_THAT(scene.profile().height, Each(::testing::DoubleNear(50, 1e-4)));
}

TEST(UpperProfile, ARulerInTheMiddleIsTakenOut) {
  const Profile profile =
      EdgeScene([](double x) { return x > 240 && x < 252 ? 5 : heap_y(x); }).profile();
  EXPECT_NEAR(profile.crest_height, 100, 1.5);
  for (std::size_t i = 0; i < profile.size(); ++i) {
    EXPECT_NEAR(profile.height[i], kEdgeGround - heap_y(profile.along[i]), 1e-4);
  }
  EXPECT_EQ(height_at(profile, 246), -1) << "nothing is known of the ruler's columns";
  EXPECT_GT(height_at(profile, 230), 0);
  EXPECT_GT(height_at(profile, 262), 0);
}

TEST(UpperProfile, AWallAtTheEndIsTakenOut) {
  for (const bool left : {false, true}) {
    const auto edge = [&](double x) {
      return (left ? x < 30 : x > kEdgeCols - 30) ? 5 : std::min(heap_y(x), kEdgeGround - 20);
    };
    const Profile profile = EdgeScene(edge).profile();
    EXPECT_NEAR(profile.crest_height, 100, 1.5) << left;
    EXPECT_NEAR(height_at(profile, left ? 45 : kEdgeCols - 45), 20, 1) << left;
    EXPECT_EQ(height_at(profile, left ? 10 : kEdgeCols - 10), -1) << left;
  }
}

TEST(UpperProfile, AHeapsOwnEdgeIsKept) {
  // A half heap whose crest leans against an invisible wall: it begins at its full height.
  const auto half_heap = [](double x) {
    return x < 80 ? kEdgeRows : kEdgeGround - std::max(0.0, 150 - 0.6 * (x - 80));
  };
  const Profile profile = EdgeScene(half_heap).profile();
  EXPECT_NEAR(profile.along.front(), 80.5, 1e-9);
  EXPECT_NEAR(profile.height.front(), 150, 1);
  EXPECT_NEAR(profile.crest_height, 150, 3);
}

TEST(UpperProfile, SteepGrainsAreNoTower) {
  const auto grains = [](double x) {  // bumps of 12 px on a flank of 38 degrees
    return kEdgeGround - std::max(0.0, 120 - 0.78 * std::abs(x - 200)) - 6 * std::sin(x / 4);
  };
  EXPECT_GT(EdgeScene(grains).profile().size(), 300);
}

TEST(UpperProfile, TellsWhereTheBodyLeavesTheFrame) {
  const Profile left =
      EdgeScene([](double x) { return kEdgeGround - std::max(0.0, 90 - 0.5 * x); }).profile();
  EXPECT_TRUE(left.leaves_frame_left);
  EXPECT_FALSE(left.leaves_frame_right || left.leaves_frame_top);
  const Profile right = EdgeScene([](double x) {
                          return kEdgeGround - std::max(0.0, 90 - 0.5 * (kEdgeCols - x));
                        }).profile();
  EXPECT_TRUE(right.leaves_frame_right);
  EXPECT_FALSE(right.leaves_frame_left || right.leaves_frame_top);
  const Profile top = EdgeScene([](double x) {
                        return kEdgeGround - std::max(0.0, 220 - 1.3 * std::abs(x - 200));
                      }).profile();
  EXPECT_TRUE(top.leaves_frame_top);
  EXPECT_FALSE(top.leaves_frame_left || top.leaves_frame_right);
}

TEST(UpperProfile, AFlatCrestHasItsCrestInTheMiddle) {
  const auto flat = [](double x) { return std::max(kEdgeGround - 60, heap_y(x)); };
  EXPECT_NEAR(EdgeScene(flat).profile().along[EdgeScene(flat).profile().crest], 200, 1);
}

TEST(UpperProfile, AnEdgeHiddenByAnExcludedBoxIsUnknown) {
  EdgeScene scene(heap_y);
  scene.work.valid_mask(cv::Rect(150, 60, 20, 80)) = 0;
  scene.body.mask(cv::Rect(150, 60, 20, 80)) = 0;
  const Profile profile = scene.profile();
  EXPECT_EQ(height_at(profile, 160), -1);
  EXPECT_THAT(profile.height, Each(Gt(-1e-3)));
  EXPECT_NEAR(height_at(profile, 140.5), kEdgeGround - heap_y(140.5), 1e-3);
}

TEST(UpperProfile, NoBodyHasNone) {
  EXPECT_EQ(EdgeScene([](double) { return kEdgeRows + 1; }).profile().size(), 0);
}

TEST(MovingAverage, IsNarrowerAtTheEnds) {
  EXPECT_THAT(moving_average({3, 6, 0, 3, 9}, 3), ElementsAre(3, 3, 3, 4, 9));
  EXPECT_THAT(moving_average({5}, 7), ElementsAre(5));
  EXPECT_THAT(moving_average({}, 3), ElementsAre());
}

TEST(MovingAverage, LeavesALineAsItIs) {
  EXPECT_THAT(moving_average({1, 2, 3, 4, 5, 6}, 5), ElementsAre(1, 2, 3, 4, 5, 6));
}

}  // namespace
}  // namespace repose::vision
