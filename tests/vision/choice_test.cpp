#include "vision/measure/choice.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/vision/pictures.h"

namespace repose::vision {
namespace {

constexpr int kSmallWidth = 640;

SelectedCandidate choice_of(const cv::Mat& picture) { return choose_reading(work_of(picture), {}); }

Reading reading_of(const cv::Mat& picture) {
  const WorkingPicture work = work_of(picture);
  return read_heap(grey_otsu(work), work, {});
}

cv::Mat blurred(const cv::Mat& picture, double sigma_px) {
  cv::Mat soft;
  cv::GaussianBlur(picture, soft, {}, sigma_px);
  return soft;
}

TEST(Score, IsHigherForASharpEdgeThanForASoftOne) {
  const auto heap = drawn("silhouette", 1, kSmallWidth);
  const Reading sharp = reading_of(mat_of(heap.picture));
  const Reading soft = reading_of(blurred(mat_of(heap.picture), 6));
  EXPECT_GT(sharp.score, 0.55) << "nothing is clearer than a silhouette";
  EXPECT_LT(soft.score, sharp.score);
  EXPECT_LT(soft.edge_sharpness, sharp.edge_sharpness);
}

TEST(Score, IsHigherForAStrongEdgeThanForAFaintOne) {
  const auto heap = drawn("silhouette", 1, kSmallWidth);
  const cv::Mat strong = mat_of(heap.picture);
  const cv::Mat faint = strong * 0.02 + cv::Scalar::all(120);
  EXPECT_LT(reading_of(faint).edge_contrast, reading_of(strong).edge_contrast);
  EXPECT_LT(reading_of(faint).score, reading_of(strong).score);
}

TEST(ReadHeap, APictureWithoutOneHasNoFlankAndNoScore) {
  const Reading reading = reading_of(cv::Mat3b(200, 300, cv::Vec3b(90, 90, 90)));
  EXPECT_FALSE(reading.has_flank());
  EXPECT_EQ(reading.score, 0);
}

TEST(Reading, AngleIsTheMeanOfTheSidesThatExist) {
  Reading reading;
  EXPECT_EQ(reading.angle_rad(), 0);
  reading.left.angle_rad = 0.4;
  reading.left.status = FlankStatus::ok;
  reading.right.angle_rad = 0.6;
  EXPECT_EQ(reading.angle_rad(), 0.4);
  reading.right.status = FlankStatus::ok;
  EXPECT_EQ(reading.angle_rad(), 0.5);
}

TEST(ChooseReading, SegmentationsAgreeOnAClearPicture) {
  const SelectedCandidate choice = choice_of(mat_of(drawn("clean", 2, kSmallWidth).picture));
  EXPECT_GT(choice.best.score, 0.55);
  EXPECT_LT(choice.disagreement.mean_rad, 0.3 * kDegree);
  EXPECT_LT(choice.disagreement.left_rad, 0.5 * kDegree);
}

/// A black heap on white, with a spot of colour `beside`.
cv::Mat3b masked_heap(const cv::Scalar& beside) {
  cv::Mat3b picture(400, 600, cv::Vec3b(255, 255, 255));
  const std::vector<std::vector<cv::Point>> heap = {{{120, 320}, {300, 220}, {480, 320}}};
  cv::fillPoly(picture, heap, {0, 0, 0});
  cv::circle(picture, {540, 100}, 3, beside, cv::FILLED);
  return picture;
}

TEST(ChooseReading, OfTwoColoursAsksOneSegmentation) {
  const SelectedCandidate two = choice_of(masked_heap({0, 0, 0}));
  EXPECT_EQ(two.best.segmentation.name, kTwoTones);
  EXPECT_EQ(two.disagreement.mean_rad, 0);
  EXPECT_NEAR(two.best.angle_rad(), std::atan(100. / 180), 0.3 * kDegree);
  const SelectedCandidate three = choice_of(masked_heap({0, 0, 200}));
  EXPECT_NE(three.best.segmentation.name, kTwoTones);
  EXPECT_NEAR(three.best.angle_rad(), two.best.angle_rad(), 0.3 * kDegree);
}

TEST(ChooseReading, OfTwoColoursHearsWhatAPersonSays) {
  MeasureOptions options;
  options.hints.heap = Box{.x = 60, .y = 150, .width = 480, .height = 200};
  const WorkingPicture work =
      working_picture(picture_of(masked_heap({0, 0, 0})), {}, options.hints);
  const SelectedCandidate choice = choose_reading(work, options);
  EXPECT_NE(choice.best.segmentation.name, kTwoTones);
  EXPECT_NEAR(choice.best.angle_rad(), std::atan(100. / 180), 0.3 * kDegree);
}

TEST(ChooseReading, TakesTheSegmentationThatSeesTheHeap) {
  // As bright as its backdrop but of a different colour: lightness shows nothing.
  cv::Mat3b picture(400, 600, cv::Vec3b(150, 130, 130));
  const std::vector<std::vector<cv::Point>> heap = {{{120, 320}, {300, 220}, {480, 320}}};
  cv::fillPoly(picture, heap, {70, 135, 165});
  const SelectedCandidate choice = choice_of(picture);
  ASSERT_TRUE(choice.best.has_flank());
  EXPECT_NE(choice.best.segmentation.name, "otsu lightness");
  EXPECT_NEAR(choice.best.angle_rad(), std::atan(100. / 180), 0.3 * kDegree);
}

/// A heap that begins 40 pixels below the table's far edge; every row darker than the backdrop.
cv::Mat3b before_the_tables_edge(const cv::Scalar& table) {
  cv::Mat3b picture(400, 600, cv::Vec3b(220, 220, 220));
  cv::rectangle(picture, {0, 250, 600, 150}, table, cv::FILLED);
  const std::vector<std::vector<cv::Point>> heap = {{{90, 290}, {300, 150}, {510, 290}}};
  cv::fillPoly(picture, heap, {40, 90, 150});
  return picture;
}

TEST(ChooseReading, TakesTheReadingThatSeesTheHeapsFoot) {
  // Only colour shows the grey table to belong with the backdrop.
  const SelectedCandidate choice = choice_of(before_the_tables_edge({100, 100, 100}));
  ASSERT_TRUE(choice.best.has_flank());
  EXPECT_FALSE(choice.best.body.ground.behind);
  EXPECT_NEAR(choice.best.body.ground.y(300), 290, 3);
}

TEST(ChooseReading, WhereNoReadingSeesTheFootTheFlanksAboveTheTablesEdgeAreMeasured) {
  // The table is nearer to the heap than to the backdrop, in every channel.
  const SelectedCandidate choice = choice_of(before_the_tables_edge({60, 95, 140}));
  ASSERT_TRUE(choice.best.has_flank());
  EXPECT_GT(choice.best.score, 0.5);
  EXPECT_NEAR(choice.best.angle_rad(), std::atan(140. / 210), 0.5 * kDegree);
}

TEST(ChooseReading, AnEdgeAboveARoundFootIsBehindTheHeap) {
  // Only colour shows the foot. By lightness the heap ends at the table's far edge, the sharpest
  // line of all; it is darker below, so that its material does not seem to continue.
  cv::Mat3b picture(400, 600, cv::Vec3b(220, 220, 220));
  cv::rectangle(picture, {0, 250, 600, 150}, {100, 100, 100}, cv::FILLED);
  cv::Mat1b heap(picture.size(), std::uint8_t{0});
  const std::vector<std::vector<cv::Point>> cone = {{{90, 290}, {300, 150}, {510, 290}}};
  cv::fillPoly(heap, cone, 255);
  cv::ellipse(heap, {300, 290}, {210, 18}, 0, 0, 360, 255, cv::FILLED);
  picture.rowRange(0, 250).setTo(cv::Scalar(40, 100, 150), heap.rowRange(0, 250));
  picture.rowRange(250, 400).setTo(cv::Scalar(20, 70, 110), heap.rowRange(250, 400));
  const SelectedCandidate choice = choice_of(picture);
  ASSERT_TRUE(choice.best.has_flank());
  EXPECT_FALSE(choice.best.body.ground.behind);
  EXPECT_GT(choice.best.body.ground.y(300), 285);
  EXPECT_GT(choice.best.body.ground.bow.value_or(0), 0.02);
}

TEST(ChooseReading, APlateThatCarriesAHeapIsNoHeap) {
  // As bright as its backdrop, on a dark plate whose far edge tilts and whose right side slopes:
  // lightness shows only the plate, more sharply than colour shows the heap.
  cv::Mat3b picture(400, 600, cv::Vec3b(140, 140, 140));
  const std::vector<std::vector<cv::Point>> plate = {
      {{-60, 340}, {-60, 316}, {520, 296}, {620, 340}}};
  const std::vector<std::vector<cv::Point>> heap = {{{150, 312}, {300, 220}, {450, 312}}};
  const cv::Scalar grains(132, 140, 143);
  cv::fillPoly(picture, plate, {40, 40, 40});
  cv::fillPoly(picture, heap, grains);
  cv::ellipse(picture, {300, 312}, {150, 10}, 0, 0, 360, grains, cv::FILLED);
  const WorkingPicture work = work_of(picture);
  Reading sharpest;
  for (const Segmentation& segmentation : unsupervised_segmentations(work)) {
    const Reading reading = read_heap(segmentation, work, {});
    if (reading.score > sharpest.score) sharpest = reading;
  }
  ASSERT_LT(sharpest.profile.crest_height, 60) << "the plate is no easier to see than its heap";
  const SelectedCandidate choice = choose_reading(work, {});
  ASSERT_TRUE(choice.best.has_flank());
  EXPECT_GT(choice.best.profile.crest_height, 80);
  EXPECT_NEAR(choice.best.angle_rad(), std::atan(92. / 150), 0.5 * kDegree);
}

TEST(ChooseReading, AnUprightBodyIsSaidToBeOne) {
  const SelectedCandidate choice = choice_of(mat_of(drawn("column", 1, kSmallWidth).picture));
  EXPECT_FALSE(choice.best.has_flank());
  EXPECT_TRUE(choice.best.left.vertical || choice.best.right.vertical);
}

}  // namespace
}  // namespace repose::vision
