#include "vision/drawing/overlay.h"

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "base/input_error.h"
#include "tests/vision/plain_picture.h"
#include "vision/drawing/canvas.h"
#include "vision/picture/opencv.h"

namespace repose::vision {
namespace {

using ::testing::Each;
using ::testing::Gt;
using ::testing::Le;
using ::testing::SizeIs;

/// A triangle on a level ground line, both sides measured.
ReposeAngle measured_triangle(int width, int height) {
  const double ground = 0.8 * height, top = 0.4 * height;
  const Point left{0.1 * width, ground}, right{0.9 * width, ground}, crest{0.5 * width, top};
  const auto part = [](Point from, Point to) {
    const auto at = [&](double t) {
      return Point{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
    };
    return Segment{at(0.2), at(0.8)};
  };
  ReposeAngle measured;
  measured.status = MeasureStatus::ok;
  measured.angle_rad = 0.4;
  measured.uncertainty_rad = 0.01;
  measured.outline = {left, crest, right};
  measured.ground = Segment{left, right};
  for (Flank* flank : {&measured.left, &measured.right}) {
    flank->status = FlankStatus::ok;
    flank->angle_rad = 0.4;
    flank->uncertainty_rad = 0.02;
  }
  measured.left.line = part(left, crest);
  measured.right.line = part(right, crest);
  return measured;
}

cv::Vec3b pixel(const Picture& picture, double x, double y) {
  return mat_of(picture).at<cv::Vec3b>(static_cast<int>(y), static_cast<int>(x));
}

TEST(Overlay, SmallPicturesAreEnlargedAndLargeOnesReduced) {
  for (const auto& [given, drawn] : {std::pair(200, 800), {900, 900}, {6000, 2400}}) {
    const Picture overlay =
        draw_overlay(plain_picture(given, given / 2, 128), measured_triangle(given, given / 2));
    EXPECT_EQ(overlay.width, drawn);
    EXPECT_GT(overlay.height, drawn / 2) << "the caption is added below";
  }
}

TEST(Overlay, LinesShowOnAnyBackground) {
  constexpr int kWidth = 1000, kHeight = 700;
  for (const int brightness : {0, 128, 255}) {
    const Picture overlay =
        draw_overlay(plain_picture(kWidth, kHeight, static_cast<std::uint8_t>(brightness)),
                     measured_triangle(kWidth, kHeight));
    // Middle of the left flank's window and of the ground line: coloured, so not grey.
    for (const cv::Vec3b& colour :
         {pixel(overlay, 0.3 * kWidth, 0.6 * kHeight), pixel(overlay, 500, 0.8 * kHeight)}) {
      const auto [low, high] = std::minmax({colour[0], colour[1], colour[2]});
      EXPECT_GT(high - low, 60) << brightness;
    }
  }
}

TEST(Overlay, TheHeapKeepsItsLightAndItsSurroundingsAreDimmed) {
  const Picture overlay = draw_overlay(plain_picture(1000, 700, 200), measured_triangle(1000, 700));
  EXPECT_EQ(pixel(overlay, 500, 450), cv::Vec3b(200, 200, 200));
  EXPECT_LT(pixel(overlay, 500, 50)[0], 200);
}

TEST(Overlay, EveryWarningMakesTheCaptionHigher) {
  ReposeAngle measured = measured_triangle(900, 600);
  const int height = draw_overlay(plain_picture(900, 600, 90), measured).height;
  measured.status = MeasureStatus::flagged;
  measured.warnings = {{"few_grains", "The heap is only 8 grains high."}};
  EXPECT_GT(draw_overlay(plain_picture(900, 600, 90), measured).height, height);
}

TEST(Overlay, RefusedPicturesAreDrawnWithTheReason) {
  ReposeAngle refused;
  refused.reason = "no heap was found. Fix: take the picture from the side.";
  const Picture overlay = draw_overlay(plain_picture(900, 600, 90), refused);
  EXPECT_EQ(pixel(overlay, 450, 300), cv::Vec3b(90, 90, 90)) << "nothing to draw";
  EXPECT_GT(overlay.height, 600);
}

TEST(Overlay, OddShapesAndLinesOutsideThePictureAreNoTrouble) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 3000), cv::Size(3000, 2)}) {
    ReposeAngle measured = measured_triangle(size.width, size.height);
    measured.left.line = Segment{{-500, 900}, {4000, -700}};
    measured.right.line = Segment{{5, 5}, {5, 5}};
    const Picture overlay = draw_overlay(
        plain_picture(size.width, size.height, 90), measured,
        {.title = std::string(300, 'x'), .excluded = {{0, 0, size.width, size.height}}});
    EXPECT_GE(overlay.width, 640);
  }
}

TEST(Overlay, SamePictureSameBytes) {
  const auto draw = [] {
    return draw_overlay(plain_picture(700, 500, 90), measured_triangle(700, 500)).bgr;
  };
  EXPECT_EQ(draw(), draw());
}

TEST(Overlay, NoPictureIsRefused) {
  EXPECT_THROW(draw_overlay(Picture{}, ReposeAngle{}), base::InputError);
}

class LetteringKinds : public ::testing::TestWithParam<bool> {
 protected:
  const Lettering lettering_{GetParam() ? usual_fonts() : std::span<const std::filesystem::path>{}};
};

TEST_P(LetteringKinds, DrawsWithinItsBox) {
  constexpr int kHeight = 40;
  const std::string text = "23.4° ± 0.5° gjy";
  cv::Mat image(100, 800, CV_8UC3, cv::Scalar::all(0));
  lettering_.draw(image, text, {20, 20}, kHeight, cv::Scalar::all(255));
  std::vector<cv::Point> lit;
  cv::Mat grey;
  cv::extractChannel(image, grey, 0);
  cv::findNonZero(grey, lit);
  ASSERT_THAT(lit, SizeIs(Gt(100U)));
  for (const cv::Point point : lit) {
    EXPECT_GE(point.y, 20 - 2);
    EXPECT_LE(point.y, 20 + kHeight + 2);
    EXPECT_LE(point.x, 20 + lettering_.width(text, kHeight) + 2);
  }
}

TEST_P(LetteringKinds, WrapsAtBlanksAndBreaksOnlyWordsThatAreTooLong) {
  const int width = lettering_.width("a short line", 20);
  const auto lines =
      lettering_.wrap("a short line and one_word_that_is_far_too_long_for_it", 20, width);
  EXPECT_EQ(lines.front(), "a short line");
  std::vector<int> widths;
  for (const std::string& line : lines) widths.push_back(lettering_.width(line, 20));
  EXPECT_THAT(widths, Each(Le(width)));
}

INSTANTIATE_TEST_SUITE_P(FontAndStrokes, LetteringKinds, ::testing::Bool());

}  // namespace
}  // namespace repose::vision
