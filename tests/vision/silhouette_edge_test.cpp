#include <functional>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "vision/measure/outline_angle.h"

namespace repose::vision {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

/// A picture that is dark where `is_dark` is true.
Picture dark_where(int width, int height, const std::function<bool(int column, int row)>& is_dark) {
  Picture picture{.width = width, .height = height, .bgr = {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      picture.bgr.insert(picture.bgr.end(), 3, is_dark(column, row) ? 20 : 230);
    }
  }
  return picture;
}

TEST(SilhouetteEdge, IsTheUpperSideOfTheHighestDarkPixels) {
  const Picture stairs = dark_where(4, 10, [](int column, int row) { return row >= 5 + column; });
  const Outline edge = silhouette_edge(stairs, {0, 0, 4, 10}, 9);
  EXPECT_THAT(edge.along, ElementsAre(.5, 1.5, 2.5, 3.5));
  EXPECT_THAT(edge.height, ElementsAre(4, 3, 2, 1));
}

TEST(SilhouetteEdge, HolesBelowItDoNotShow) {
  const Picture holed =
      dark_where(3, 10, [](int column, int row) { return row >= 4 && !(column == 1 && row == 6); });
  EXPECT_THAT(silhouette_edge(holed, {0, 0, 3, 10}, 10).height, Each(6));
}

TEST(SilhouetteEdge, WhatAGapPartsFromTheHighestPlaceIsLeftOut) {
  const Picture parted = dark_where(7, 10, [](int column, int row) {
    return column != 1 && column != 5 && row >= (column == 3 ? 4 : 6);
  });
  const Outline edge = silhouette_edge(parted, {0, 0, 7, 10}, 10);
  EXPECT_THAT(edge.along, ElementsAre(2.5, 3.5, 4.5));
  EXPECT_THAT(edge.height, ElementsAre(4, 6, 4));
}

TEST(SilhouetteEdge, OnlyThePartAboveTheGroundIsSeen) {
  const Picture dark = dark_where(6, 10, [](int, int) { return true; });
  const Outline edge = silhouette_edge(dark, {2, 3, 2, 7}, 7.5);
  EXPECT_THAT(edge.along, ElementsAre(2.5, 3.5));
  EXPECT_THAT(edge.height, ElementsAre(4.5, 4.5));
  EXPECT_TRUE(silhouette_edge(dark, {2, 8, 2, 2}, 7.5).along.empty());
  const Picture blank = dark_where(6, 10, [](int, int) { return false; });
  EXPECT_TRUE(silhouette_edge(blank, {0, 0, 6, 10}, 10).along.empty());
}

TEST(SilhouetteEdge, APartOutsideThePictureIsRefused) {
  const Picture picture = dark_where(6, 10, [](int, int) { return true; });
  for (const Box part : {Box{-1, 0, 2, 2}, Box{0, 0, 7, 2}, Box{0, 9, 2, 2}, Box{0, 0, 0, 2}}) {
    EXPECT_THROW(silhouette_edge(picture, part, 5), base::InputError) << part.x;
  }
}

}  // namespace
}  // namespace repose::vision
