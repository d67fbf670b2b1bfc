#include "vision/measure/silhouette_edge.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"

namespace repose::vision {
namespace {

constexpr int kHalfGrey = 128;

void check(const Picture& picture, const Box& part) {
  const bool is_inside = part.x >= 0 && part.y >= 0 && part.width >= 1 && part.height >= 1 &&
                         part.width <= picture.width - part.x &&
                         part.height <= picture.height - part.y;
  if (is_inside) return;
  throw base::InputError(
      {.subject = "part",
       .value = fmt::format("= {},{},{},{}", part.x, part.y, part.width, part.height),
       .rule = fmt::format("must lie inside the {} x {} picture", picture.width, picture.height),
       .fix = "give the top-left pixel, width and height in pixels of the picture."});
}

bool is_dark(const Picture& picture, int column, int row) {
  const auto at = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) +
                       static_cast<std::size_t>(column));
  const int sum = picture.bgr[at] + picture.bgr[at + 1] + picture.bgr[at + 2];
  return sum < 3 * kHalfGrey;
}

/// Of the highest dark pixel above the ground; 0 when there is none.
double height_in(const Picture& picture, const Box& part, int column, double ground_y) {
  for (int row = part.y; row < part.y + part.height && row < ground_y; ++row) {
    if (is_dark(picture, column, row)) return ground_y - row;
  }
  return 0;
}

}  // namespace

Outline silhouette_edge(const Picture& silhouette, const Box& part, double ground_y) {
  check(silhouette, part);
  std::vector<double> heights;
  for (int column = part.x; column < part.x + part.width; ++column) {
    heights.push_back(height_in(silhouette, part, column, ground_y));
  }
  const auto highest = std::max_element(heights.begin(), heights.end());
  auto first = highest;
  while (first != heights.begin() && *(first - 1) > 0) --first;
  const auto last = std::find(highest, heights.end(), 0.0);
  Outline outline;
  for (auto height = first; height != last; ++height) {
    const auto column = part.x + static_cast<int>(height - heights.begin());
    outline.along.push_back(column + .5);
    outline.height.push_back(*height);
  }
  return outline;
}

}  // namespace repose::vision
