#include "render/silhouette/silhouette.h"

#include <algorithm>
#include <cmath>

#include "render/scene/ground.h"

namespace repose::render {
namespace {

constexpr std::uint8_t kGroundGrey = 128;

/// All below the ground line that shows no grain.
void paint_ground(vision::Picture& picture, const vision::Segment& ground) {
  const double slope = (ground.to.y - ground.from.y) / (ground.to.x - ground.from.x);
  for (int x = 0; x < picture.width; ++x) {
    const double line = ground.from.y + slope * (x + .5 - ground.from.x);
    const int first = static_cast<int>(std::clamp(std::ceil(line - .5), 0.0, 1.0 * picture.height));
    for (int y = first; y < picture.height; ++y) {
      const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                           static_cast<std::size_t>(x));
      for (std::size_t k = at; k < at + 3; ++k) {
        if (picture.bgr[k] != 0) picture.bgr[k] = kGroundGrey;
      }
    }
  }
}

}  // namespace

vision::Picture silhouette_of(const Scene& scene, const View& view, const SilhouetteStyle& style,
                              const std::vector<std::uint8_t>& grain_mask) {
  vision::Picture picture{.width = view.size.width, .height = view.size.height, .bgr = {}};
  picture.bgr.resize(3 * grain_mask.size());
  std::uint8_t* to = picture.bgr.data();
  for (const std::uint8_t grain : grain_mask) {
    to = std::fill_n(to, 3, static_cast<std::uint8_t>(255 - grain));
  }
  if (style.shows_ground) {
    if (const auto ground = ground_in_picture(scene, view)) paint_ground(picture, *ground);
  }
  return picture;
}

}  // namespace repose::render
