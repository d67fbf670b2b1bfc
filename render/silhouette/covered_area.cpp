#include "render/silhouette/covered_area.h"

#include <algorithm>
#include <cmath>

namespace repose::render {
namespace {

/// Calls `use(y, first, end)` for each row of pixels whose middles lie in a disc.
template <class Use>
void for_rows(const PictureSize& size, const vision::Point& middle, double radius_px, Use use) {
  const auto clipped = [](double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  const int bottom = clipped(std::ceil(middle.y + radius_px), size.height);
  for (int y = clipped(std::floor(middle.y - radius_px), size.height); y < bottom; ++y) {
    const double dy = y + .5 - middle.y;
    const double half2 = radius_px * radius_px - dy * dy;
    if (half2 <= 0) continue;
    const double half = std::sqrt(half2);
    const int first = clipped(std::ceil(middle.x - half - .5), size.width);
    const int end = clipped(std::floor(middle.x + half - .5) + 1, size.width);
    if (first < end) use(y, first, end);
  }
}

}  // namespace

void cover_disc(std::vector<std::uint8_t>& mask, const PictureSize& size,
                const vision::Point& middle, double radius_px) {
  for_rows(size, middle, radius_px, [&](int y, int first, int end) {
    const auto row = mask.begin() + std::ptrdiff_t{y} * size.width;
    std::fill(row + first, row + end, std::uint8_t{255});
  });
}

CoveredArea::CoveredArea(const std::vector<std::uint8_t>& mask, const PictureSize& size)
    : size_(size), before_(at(size.height + 1, 0)) {
  auto pixel = mask.begin();
  for (int y = 0; y < size.height; ++y) {
    std::uint32_t in_row = 0;
    for (int x = 0; x < size.width; ++x, ++pixel) {
      in_row += *pixel != 0 ? 1U : 0U;
      before(y + 1, x + 1) = before(y, x + 1) + in_row;
    }
  }
}

bool CoveredArea::hides_box(const PixelBox& box) const {
  const int first_x = std::max(box.first_x, 0), end_x = std::min(box.end_x, size_.width);
  const int first_y = std::max(box.first_y, 0), end_y = std::min(box.end_y, size_.height);
  if (first_x >= end_x || first_y >= end_y) return true;
  const std::uint32_t covered = before(end_y, end_x) - before(first_y, end_x) -
                                before(end_y, first_x) + before(first_y, first_x);
  return covered ==
         static_cast<std::uint32_t>(end_x - first_x) * static_cast<std::uint32_t>(end_y - first_y);
}

bool CoveredArea::hides_disc(const vision::Point& middle, double radius_px) const {
  bool is_hidden = true;
  for_rows(size_, middle, radius_px, [&](int y, int first, int end) {
    is_hidden = is_hidden && hides_box({first, end, y, y + 1});
  });
  return is_hidden;
}

}  // namespace repose::render
