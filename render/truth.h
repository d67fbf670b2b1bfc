#pragma once

#include <optional>
#include <vector>

#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "render/scene/style.h"
#include "vision/picture/picture.h"

namespace repose::render {

/// Exact ground truth of a picture. Lengths in pixels as in vision/picture/picture.h.
struct Truth {
  Camera camera;
  PictureSize size;
  double mm_per_px = 0;  ///< in the vertical plane through the grains' middle that faces the camera
  /// Where the ground meets that plane, across the picture's width; curved by the lens in between.
  /// std::nullopt if nothing level is below the grains or it is out of view.
  std::optional<vision::Segment> ground;
  /// Upper edge of all grains at the centre of each pixel column that has any, left to right.
  std::vector<vision::Point> outline;
};

/// The outline is that of full meshes and exact spheres, independent of how they are drawn.
Truth truth_of(const Scene& scene, const Camera& camera, const PictureSize& size, Shown shown);

}  // namespace repose::render
