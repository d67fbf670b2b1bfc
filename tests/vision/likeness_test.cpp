#include "vision/measure/likeness.h"

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <vector>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

#include "tests/support/heap_random.h"
#include "tests/vision/pictures.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A light picture with camera noise in which `draw` paints something dark.
template <class Draw>
Picture painted(Draw draw) {
  cv::Mat3b picture(480, 640, cv::Vec3b(215, 220, 225));
  picture.rowRange(400, 480).setTo(cv::Vec3b(120, 125, 130));
  draw(picture);
  cv::GaussianBlur(picture, picture, {}, 0.7);
  testing::Random random(4);
  for (cv::Vec3b& pixel : picture) {
    for (int c = 0; c < 3; ++c) {
      pixel[c] = cv::saturate_cast<std::uint8_t>(pixel[c] + random.normal(0, 1.5));
    }
  }
  return picture_of(picture);
}

const cv::Scalar kBrown(40, 70, 110);

void fill(cv::Mat3b& picture, const std::vector<cv::Point>& corners, const cv::Scalar& colour) {
  cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{corners}, colour);
}

TEST(HeapPlausibility, DrawnHeapsLookLikeHeaps) {
  for (const char* condition : {"clean", "silhouette", "half_heap", "hollow_power", "few_grains",
                                "hazelnut", "apron", "blur_noise_jpeg"}) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const ReposeAngle result = measure_repose_angle(drawn(condition, seed, 800).picture);
      EXPECT_THAT(result.warnings, Not(Contains(Field(&Warning::code, "unlike_a_heap"))))
          << condition << seed;
    }
  }
}

TEST(HeapPlausibility, ASmoothTriangleIsFlagged) {
  const Picture sign = painted([](cv::Mat3b& picture) {
    fill(picture, {{120, 400}, {320, 280}, {520, 400}}, kBrown);
  });
  const ReposeAngle result = measure_repose_angle(sign);
  EXPECT_EQ(result.status, MeasureStatus::flagged);
  EXPECT_THAT(result.warnings, Contains(Field(&Warning::code, "unlike_a_heap")));
  MeasureOptions told;
  told.hints.heap = Box{.x = 60, .y = 230, .width = 520, .height = 200};
  EXPECT_THAT(measure_repose_angle(sign, told).warnings,
              Not(Contains(Field(&Warning::code, "unlike_a_heap"))));
}

/// A body with a level base at y = 100 and an upper edge at `top`, empty from `gap_from` down to
/// the base between columns 80 and 220.
Reading body_with_gap(int top, int gap_from) {
  Reading reading;
  reading.body.mask = cv::Mat1b::zeros(120, 300);
  reading.body.mask(cv::Rect(50, top, 200, 100 - top)) = 255;
  reading.body.mask(cv::Rect(80, gap_from, 140, 100 - gap_from)) = 0;
  reading.body.ground.y_at_0 = 100;
  for (int col = 50; col < 250; ++col) {
    reading.profile.along.push_back(col + 0.5);
    reading.profile.height.push_back(100 - top);
  }
  set_crest(reading.profile);
  return reading;
}

TEST(HeapPlausibility, LegsLeaveGapsThatToesDoNot) {
  const WorkingPicture work = work_of(cv::Mat3b(120, 300, cv::Vec3b(90, 90, 90)));
  EXPECT_EQ(likeness_of(body_with_gap(20, 100), work).filled, 1);
  EXPECT_EQ(likeness_of(body_with_gap(20, 96), work).filled, 1);  // under 6 % of the height
  // 140 of 200 columns are empty in 36 - 4.8 of 80 - 4.8 rows.
  EXPECT_NEAR(likeness_of(body_with_gap(20, 64), work).filled, 1 - 0.7 * 31.2 / 75.2, 0.01);
}

TEST(HeapPlausibility, AnEdgeThatRisesAgainClimbs) {
  const WorkingPicture work = work_of(cv::Mat3b(120, 300, cv::Vec3b(90, 90, 90)));
  Reading reading = body_with_gap(20, 100);
  for (std::size_t i = 0; i < 200; ++i) {  // two humps, 80 and 60 high, and 40 between them
    const double x = static_cast<double>(i);
    reading.profile.height[i] = x < 100 ? 40 + 40 * std::sin(x / 100 * std::numbers::pi)
                                        : 40 + 20 * std::sin((x - 100) / 100 * std::numbers::pi);
  }
  set_crest(reading.profile);
  EXPECT_NEAR(likeness_of(reading, work).climb, 20.0 / 80, 0.02);
}

TEST(HeapPlausibility, TreadsOfStairsAreLevelAndASlopeIsNot) {
  const WorkingPicture work = work_of(cv::Mat3b(120, 300, cv::Vec3b(90, 90, 90)));
  Reading reading = body_with_gap(20, 100);
  FlankFit& flank = reading.right;
  flank.status = FlankStatus::ok;
  flank.robust.slope = -0.5;
  for (int i = 0; i < 200; ++i) flank.height.push_back(100 - 0.5 * i);
  EXPECT_EQ(likeness_of(reading, work).level, 0);
  for (int i = 0; i < 200; ++i) {
    const int risers = i / 20;
    flank.height.at(i) = 100 - 10 * risers;
  }
  EXPECT_NEAR(likeness_of(reading, work).level, 1 - 5.0 / 20, 0.03);  // except five at each riser
}

TEST(ReasonAgainstHeap, NamesWhatSpeaksAgainstIt) {
  const HeapPlausibility heap;
  EXPECT_THAT(reason_against_heap(heap, 8), IsEmpty());
  const auto reason = [](auto change, std::optional<double> grain = 8) {
    HeapPlausibility other;
    change(other);
    return reason_against_heap(other, grain);
  };
  EXPECT_THAT(reason([](HeapPlausibility& l) { l.filled = 0.9; }),
              HasSubstr("10 % of the area under"));
  EXPECT_THAT(reason([](HeapPlausibility& l) { l.climb = 0.2; }), HasSubstr("rises again by 20 %"));
  EXPECT_THAT(reason([](HeapPlausibility& l) { l.level = 0.8; }),
              HasSubstr("80 % of its edge is level"));
  EXPECT_THAT(reason([](HeapPlausibility& l) { l.inside.straight = 1.5; }),
              HasSubstr("1.5 times as long"));
  EXPECT_THAT(reason([](HeapPlausibility& l) { l.inside.patchy = 0.3; }),
              HasSubstr("different colours"));
  EXPECT_THAT(reason([](HeapPlausibility& l) { l.inside.aligned = 0.6; }),
              HasSubstr("straight lines"));
  EXPECT_THAT(reason([](HeapPlausibility& l) { l.inside.crossed = 0.6; }),
              HasSubstr("straight lines"));
  EXPECT_THAT(reason([](HeapPlausibility& l) { l.inside.regular = 0.6; }),
              HasSubstr("60 % of its pattern"));
  EXPECT_THAT(reason([](HeapPlausibility& l) { l.inside.noise = 0.2; }), HasSubstr("no grains"));
  EXPECT_THAT(reason([](HeapPlausibility&) {}, std::nullopt), HasSubstr("no grains"));
}

TEST(ReasonAgainstHeap, AnEdgeIsAsRoughAsItsGrains) {
  const auto reason = [](double rough_px, std::optional<double> grain, double sharpness = 1) {
    HeapPlausibility edge;
    edge.rough_px = rough_px;
    edge.sharpness = sharpness;
    return reason_against_heap(edge, grain);
  };
  EXPECT_THAT(reason(0.2, 8), HasSubstr("smooth"));
  EXPECT_THAT(reason(0.2, 8, 0.4), IsEmpty());  // blurred
  EXPECT_THAT(reason(0.4, 8), IsEmpty());
  EXPECT_THAT(reason(0.12, 4), IsEmpty());  // fine grains make a fine edge
}

TEST(ReasonAgainstHeap, ASilhouetteShowsNoGrainsButItsEdgeDoes) {
  HeapPlausibility silhouette;
  silhouette.inside = {.noise = 0, .even = 1, .aligned = 0.9, .crossed = 0.9, .regular = 0.9};
  silhouette.rough_px = 0.15;
  EXPECT_THAT(reason_against_heap(silhouette, std::nullopt), IsEmpty());
  silhouette.rough_px = 0.05;
  EXPECT_THAT(reason_against_heap(silhouette, std::nullopt), HasSubstr("smooth"));
}

}  // namespace
}  // namespace repose::vision
