#include <algorithm>
#include <functional>

#include <gmock/gmock.h>

#include "render/gl/context.h"
#include "render/silhouette/mask.h"
#include "render/silhouette/occlusion.h"
#include "tests/support/nut_heap.h"

namespace repose::render {
namespace {

using repose::testing::nut_heap;

constexpr PictureSize kSize{8, 6};

std::vector<std::uint8_t> covered_from(int first_x) {
  std::vector<std::uint8_t> mask;
  for (int y = 0; y < kSize.height; ++y) {
    for (int x = 0; x < kSize.width; ++x) mask.push_back(x >= first_x ? 255 : 0);
  }
  return mask;
}

TEST(CoveredArea, HidesABoxOnlyWhereAllOfItsPixelsAreCovered) {
  const CoveredArea covered(covered_from(3), kSize);
  EXPECT_TRUE(covered.hides_box({3, 8, 0, 6}));
  EXPECT_TRUE(covered.hides_box({5, 6, 2, 3}));
  EXPECT_FALSE(covered.hides_box({2, 8, 0, 6}));
  EXPECT_FALSE(covered.hides_box({2, 3, 5, 6}));
}

TEST(CoveredArea, HidesWhatLiesOutsideOfThePicture) {
  const CoveredArea covered(covered_from(8), kSize);  // nothing
  EXPECT_TRUE(covered.hides_box({-5, 0, 0, 6}));
  EXPECT_TRUE(covered.hides_box({8, 20, 0, 6}));
  EXPECT_TRUE(covered.hides_box({4, 4, 0, 6}));
  EXPECT_FALSE(covered.hides_box({-5, 1, 0, 6}));
}

TEST(CoveredArea, HidesADiscByThePixelsWhoseMiddlesLieInIt) {
  const CoveredArea covered(covered_from(3), kSize);
  EXPECT_TRUE(covered.hides_disc({5, 3}, 2.4));  // 2.6: the third pixel's middle is at 2.5
  EXPECT_FALSE(covered.hides_disc({5, 3}, 2.6));
}

/// Draws the grains alone: all of them, or only the uncovered ones.
class Uncovered : public ::testing::Test {
 protected:
  /// The whole mask, drawn either way, and the fraction of it covered before anything is drawn.
  struct Masks {
    std::vector<std::uint8_t> of_all;
    std::vector<std::uint8_t> of_uncovered;
    double covered_fraction = 0;
  };

  Masks masks(const Scene& scene, const OrthographicCamera& camera, const PictureSize& size,
              Shown shown) {
    const View view = view_of(scene, camera, size);
    const Stage stage = uploader_.set(scene, view, shown, 0);
    const Occlusion occlusion = occluded_part(scene, view, shown);
    Masks masks{painter_.paint_grains(view, stage),
                painter_.paint_uncovered(view, stage, occlusion.covered)};
    std::transform(masks.of_uncovered.begin(), masks.of_uncovered.end(), occlusion.mask.begin(),
                   masks.of_uncovered.begin(), std::bit_or<>());
    masks.covered_fraction =
        static_cast<double>(std::count(occlusion.mask.begin(), occlusion.mask.end(), 255)) /
        static_cast<double>(std::count(masks.of_all.begin(), masks.of_all.end(), 255));
    return masks;
  }

 private:
  gl::Context context_;
  const gl::Functions& gl_ = context_.use();
  SceneUploader uploader_{gl_};
  MaskPainter painter_{gl_};
};

TEST_F(Uncovered, LooksAsIfAllHadBeenDrawn) {
  const Scene heap = nut_heap(12, .5, 3);
  for (const Shown shown : {Shown::mesh, Shown::spheres, Shown::both}) {
    for (const int width : {40, 320, 1920}) {
      const Masks seen = masks(heap, {.azimuth_rad = .4 + width}, {width, width * 9 / 16}, shown);
      EXPECT_EQ(seen.of_all, seen.of_uncovered) << width;
      EXPECT_GT(seen.covered_fraction, width > 40 ? .4 : -1) << width;  // else the test is vacuous
    }
  }
}

TEST_F(Uncovered, AlsoWhereGrainsReachOutOfThePicture) {
  const Scene heap = nut_heap(8, .5, 4);
  for (const double mm_per_px : {.3, .01, 1e-6}) {
    const Masks seen = masks(heap, {.mm_per_px = mm_per_px}, {200, 150}, Shown::mesh);
    EXPECT_EQ(seen.of_all, seen.of_uncovered) << mm_per_px;
  }
}

TEST_F(Uncovered, AlsoOfAnOpenSurface) {
  Scene heap = nut_heap(6, .5, 5);
  auto& triangles = heap.shapes.front().surface.triangles;
  triangles.resize(triangles.size() / 2);
  const Masks seen = masks(heap, {.azimuth_rad = 1}, {320, 180}, Shown::mesh);
  EXPECT_EQ(seen.of_all, seen.of_uncovered);
  EXPECT_EQ(seen.covered_fraction, 0);
}

}  // namespace
}  // namespace repose::render
