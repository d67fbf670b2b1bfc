#pragma once

#include <optional>
#include <vector>

#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "render/scene/style.h"
#include "vision/picture/picture.h"

namespace repose::render {

/// What is known exactly about a picture. Lengths in pixels as in vision/picture/picture.h.
struct Truth {
  Camera camera;
  PictureSize size;
  double mm_per_px = 0;  ///< in the upright plane through the grains' middle that faces the camera
  /// Where the ground meets that plane, over the picture's width; bent by the lens in between. None
  /// when nothing level is below the grains.
  std::optional<vision::Segment> ground;
  /// Upper edge of all grains in the middle of each pixel column that has any, left to right.
  std::vector<vision::Point> outline;
};

/// The outline is that of whole meshes and exact spheres: it does not depend on how they are drawn.
Truth truth_of(const Scene& scene, const Camera& camera, const PictureSize& size, Shown shown);

}  // namespace repose::render
