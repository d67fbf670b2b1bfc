#include "render/truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "render/scene/extent.h"
#include "render/scene/view.h"
#include "render/silhouette/silhouette.h"

namespace repose::render {

Truth truth_of(const Scene& scene, const Camera& camera, const PictureSize& size, Shown shown) {
  const View view = view_of(scene, camera, size);
  const Eigen::AlignedBox3d bounds = grain_bounds(scene, Eigen::Matrix3d::Identity());
  return {.camera = camera,
          .size = size,
          .mm_per_px = view.mm_per_px(view.in_camera(bounds.center()).z()),
          .ground = ground_in_picture(scene, view),
          .outline = upper_edge(scene, view, shown)};
}

}  // namespace repose::render
