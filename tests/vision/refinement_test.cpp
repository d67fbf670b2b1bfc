#include "vision/measure/refinement.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/support/heap_random.h"
#include "tests/vision/pictures.h"

namespace repose::vision {
namespace {

constexpr int kGroundRow = 320;

cv::Mat1b triangle_mask(int half_base, int height) {
  cv::Mat1b mask = cv::Mat1b::zeros(400, 600);
  cv::fillPoly(mask,
               std::vector<std::vector<cv::Point>>{{{300 - half_base, kGroundRow - 1},
                                                    {300, kGroundRow - height},
                                                    {300 + half_base, kGroundRow - 1}}},
               255);
  return mask;
}

/// A brown heap in front of a grey backdrop, both noisy, in light that halves to the right.
struct LitScene {
  cv::Mat1b heap = triangle_mask(200, 120);
  WorkingPicture work;

  LitScene() {
    testing::Random random(1);
    cv::Mat3b picture(heap.size());
    for (int row = 0; row < picture.rows; ++row) {
      for (int col = 0; col < picture.cols; ++col) {
        const double light = (1 - 0.5 * col / picture.cols) * random.normal(1, 0.05);
        const cv::Vec3d colour =
            heap(row, col) != 0 ? cv::Vec3d(80, 110, 150) : cv::Vec3d(190, 190, 190);
        for (int k = 0; k < 3; ++k) {
          picture(row, col)[k] = cv::saturate_cast<std::uint8_t>(colour[k] * light);
        }
      }
    }
    work = work_of(picture);
  }
};

Body body_of(const cv::Mat1b& mask) {
  Body body;
  body.mask = mask;
  body.ground.y_at_0 = kGroundRow;
  return body;
}

TEST(LearnedSegmentation, SeparatesTheHeapInFallingLight) {
  const LitScene scene;
  EXPECT_GT(overlap(learned_segmentation(scene.work, body_of(scene.heap)).inside, scene.heap),
            0.97);
}

TEST(LearnedSegmentation, CorrectsABodyThatIsTooSmallOrTooLarge) {
  const LitScene scene;
  for (const auto& [half_base, height] : {std::pair(185, 109), {214, 130}}) {
    const cv::Mat1b wrong = triangle_mask(half_base, height);
    const double before = overlap(cv::Mat1f(wrong) - 1, scene.heap);
    const double after =
        overlap(learned_segmentation(scene.work, body_of(wrong)).inside, scene.heap);
    EXPECT_LT(1 - after, 0.75 * (1 - before)) << "part of the wrong strip still teaches";
  }
}

TEST(LearnedSegmentation, NothingIsInsideBelowTheGround) {
  const LitScene scene;
  const Segmentation learned = learned_segmentation(scene.work, body_of(scene.heap));
  EXPECT_EQ(cv::countNonZero(learned.inside.rowRange(kGroundRow, 400) > 0), 0);
}

TEST(LearnedSegmentation, ExcludedPixelsTeachNothing) {
  const cv::Rect label(140, 225, 320, 100);  // grey like the backdrop, over most of the heap
  const auto overlap_beside_label = [&](bool exclude) {
    LitScene scene;
    cv::cvtColor(cv::Mat3f(label.size(), cv::Vec3f(0.6F, 0.6F, 0.6F)), scene.work.lab(label),
                 cv::COLOR_BGR2Lab);
    if (exclude) scene.work.valid_mask(label) = 0;
    cv::Mat1f inside = learned_segmentation(scene.work, body_of(scene.heap)).inside;
    inside(label) = -1;
    cv::Mat1b heap = scene.heap.clone();
    heap(label) = 0;
    return overlap(inside, heap);
  };
  EXPECT_GT(overlap_beside_label(true), 0.9);  // a small remainder, much of it edge
  EXPECT_LT(overlap_beside_label(false), 0.85) << "the label must matter";
}

TEST(LearnedSegmentation, TooLittleToLearnFromHasNothingInside) {
  const LitScene scene;
  const Segmentation learned = learned_segmentation(scene.work, body_of(triangle_mask(4, 3)));
  EXPECT_EQ(cv::countNonZero(learned.inside > 0), 0);
}

TEST(GrabCutSegmentation, FindsTheHeapFromARoughBody) {
  const LitScene scene;
  const Segmentation cut = grabcut_segmentation(scene.work, body_of(triangle_mask(170, 100)), 1);
  EXPECT_GT(overlap(cut.inside, scene.heap), 0.9);  // it works on a picture 2.5 times smaller
}

TEST(GrabCutSegmentation, SameSeedGivesTheSameBits) {
  const LitScene scene;
  const Body rough = body_of(triangle_mask(170, 100));
  const cv::Mat1f first = grabcut_segmentation(scene.work, rough, 3).inside;
  cv::theRNG().next();  // previous draws from the thread's generator do not matter
  const cv::Mat1f second = grabcut_segmentation(scene.work, rough, 3).inside;
  EXPECT_EQ(cv::norm(first, second, cv::NORM_INF), 0);
}

TEST(GrabCutSegmentation, AFullOrEmptyBodyIsNotCut) {
  const LitScene scene;
  Body none = body_of(cv::Mat1b::zeros(400, 600));
  EXPECT_EQ(cv::countNonZero(grabcut_segmentation(scene.work, none, 1).inside > 0), 0);
  Body full = body_of(cv::Mat1b(400, 600, 255));
  full.ground.y_at_0 = 400;
  EXPECT_EQ(cv::countNonZero(grabcut_segmentation(scene.work, full, 1).inside > 0), 0);
}

}  // namespace
}  // namespace repose::vision
