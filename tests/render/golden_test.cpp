#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>

#include "render/renderer.h"
#include "tests/render/drawn.h"
#include "tests/support/nut_heap.h"
#include "tests/support/places.h"
#include "vision/picture/picture.h"

namespace repose::render {
namespace {

/// Difference of two pictures: fraction of bytes that differ by more than `step`, and the mean.
struct Difference {
  double fraction = 1;
  double mean = 255;
};

Difference difference(const vision::Picture& a, const vision::Picture& b, int step) {
  if (a.width != b.width || a.height != b.height) return {};
  double far = 0, sum = 0;
  for (std::size_t k = 0; k < a.bgr.size(); ++k) {
    const int away = std::abs(int{a.bgr[k]} - int{b.bgr[k]});
    far += away > step ? 1 : 0;
    sum += away;
  }
  const auto bytes = static_cast<double>(a.bgr.size());
  return {far / bytes, sum / bytes};
}

/// Compares with the stored picture. The drawn one is kept with the test's other files, for
/// inspection and to replace the stored one after an intended change.
Difference against_golden(const std::string& name, const vision::Picture& drawn, int step) {
  const auto now = std::filesystem::path(::testing::TempDir()) / ("repose_" + name);
  vision::write_picture(now, drawn);
  const auto golden = testing::source_folder() / "tests/render/golden" / name;
  if (!std::filesystem::exists(golden)) {
    ADD_FAILURE() << golden << " is missing; drawn was " << now;
    return {};
  }
  const Difference found = difference(vision::read_picture(golden), drawn, step);
  EXPECT_LT(found.fraction, 1) << "compare with " << now;
  return found;
}

const Scene& heap() {
  static const Scene scene = repose::testing::nut_heap(9, .5, 1);
  return scene;
}

// Another processor or driver version may round an edge the other way: one pixel in a thousand is
// one in thirty of the edge.
constexpr double kEdgePixels = .001;

TEST(Golden, Silhouette) {
  const Rendered drawn =
      renderer().draw(heap(), OrthographicCamera{.azimuth_rad = .3}, {320, 180}, SilhouetteStyle{});
  EXPECT_LT(against_golden("silhouette.png", drawn.picture, 0).fraction, kEdgePixels);
}

TEST(Golden, SilhouetteOfSpheresThroughALens) {
  PerspectiveCamera camera = camera_on({.azimuth_rad = 1, .distance_m = .5}, heap(), {320, 180});
  camera.k1 = -.2;
  camera.roll_rad = .05;
  const Rendered drawn =
      renderer().draw(heap(), camera, {320, 180}, SilhouetteStyle{.shown = Shown::spheres});
  EXPECT_LT(against_golden("lens.png", drawn.picture, 0).fraction, kEdgePixels);
}

TEST(Golden, Photo) {
  const PerspectiveCamera camera =
      camera_on({.distance_m = 1, .height_m = .08}, heap(), {320, 180});
  const Rendered drawn = renderer().draw(heap(), camera, {320, 180}, PhotoStyle{.passes = 8});
  // Shading differs in the last bits: two grey values, and more at a few edges.
  const Difference found = against_golden("photo.png", drawn.picture, 4);
  EXPECT_LT(found.fraction, .005);
  EXPECT_LT(found.mean, .2);
}

}  // namespace
}  // namespace repose::render
