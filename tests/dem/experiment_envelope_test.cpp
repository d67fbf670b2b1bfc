#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/input_error.h"
#include "dem/experiment/heap.h"
#include "tests/support/sphere_heap.h"

namespace repose::dem {
namespace {

using testing::sphere_cone;

double width_m(const Envelope& envelope) {
  return envelope.column_m * static_cast<double>(envelope.height_m.size());
}

TEST(HeapEnvelope, IsTheUpperSideOfASphere) {
  const std::vector<ClumpSphere> sphere = {{.centre = {.1, .2, .01}, .radius = .01}};
  for (const Envelope& envelope : heap_envelopes(sphere, 4)) {
    const std::vector<double>& height = envelope.height_m;
    const auto middle = std::max_element(height.begin(), height.end()) - height.begin();
    EXPECT_NEAR(width_m(envelope), .02, 1.1 * envelope.column_m);
    // The outermost columns are within rounding of the sphere's side, where it is vertical.
    for (std::size_t k = 1; k + 1 < height.size(); ++k) {
      const double off = (static_cast<double>(k) - static_cast<double>(middle)) * envelope.column_m;
      EXPECT_NEAR(height[k], .01 + std::sqrt(std::max(0.0, 1e-4 - off * off)), 1e-9);
    }
  }
  EXPECT_NEAR(height_m(heap_envelopes(sphere, 1)), .02, 1e-9);
}

TEST(HeapEnvelope, HasAColumnForEachTwentiethOfAMeanRadius) {
  const auto envelopes = heap_envelopes(
      {{.centre = {0, 0, .01}, .radius = .01}, {.centre = {0, 0, .01}, .radius = .03}}, 1);
  EXPECT_NEAR(envelopes.front().column_m, 1e-3, 1e-12);
  EXPECT_NEAR(width_m(envelopes.front()), .06, 1.1e-3);
}

TEST(HeapEnvelope, FirstLooksAlongYThenRoundCounterClockwise) {
  // Rows along x, along y, and from +x to +y: each looks short when viewed along its axis.
  const auto row = [](const Vector& along) {
    std::vector<ClumpSphere> spheres;
    for (int k = -20; k <= 20; ++k) {
      spheres.push_back({.centre = 5e-3 * k * along + Vector(0, 0, .01), .radius = .01});
    }
    return spheres;
  };
  const auto shortest = [](const std::vector<Envelope>& envelopes) {
    return std::min_element(envelopes.begin(), envelopes.end(),
                            [](const auto& a, const auto& b) { return width_m(a) < width_m(b); })
        ->azimuth_rad;
  };
  EXPECT_NEAR(shortest(heap_envelopes(row(Vector::UnitY()), 4)), 0, 1e-12);
  EXPECT_NEAR(shortest(heap_envelopes(row(Vector::UnitX()), 4)), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(shortest(heap_envelopes(row(Vector(-1, 1, 0).normalized()), 4)), std::numbers::pi / 4,
              1e-12);
}

TEST(HeapEnvelope, LeavesGrainsBeyondAGapOut) {
  std::vector<ClumpSphere> heap = sphere_cone(25, .06, .002);
  const double alone = width_m(heap_envelopes(heap, 1).front());
  for (int k = 0; k < 20; ++k) {
    const double turn = 2 * std::numbers::pi * k / 20;
    heap.push_back({.centre = {.5 * std::cos(turn), .5 * std::sin(turn), .02}, .radius = .02});
  }
  const Envelope envelope = heap_envelopes(heap, 1).front();
  EXPECT_NEAR(width_m(envelope), alone, 2 * envelope.column_m);
}

TEST(HeapEnvelope, IsAsHighAsTheHeap) {
  EXPECT_NEAR(height_m(heap_envelopes(sphere_cone(25, .06, .002), 18)), .06, 1e-4);
}

TEST(HeapEnvelope, RefusesWhatHasNone) {
  EXPECT_THROW(heap_envelopes({}, 18), base::InputError);
  EXPECT_THROW(heap_envelopes({{.centre = {0, 0, -1}, .radius = .01}}, 18), base::InputError);
  EXPECT_THROW(heap_envelopes(sphere_cone(25, .06, .002), 0), base::InputError);
}

}  // namespace
}  // namespace repose::dem
