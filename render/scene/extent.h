#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "render/scene/scene.h"
#include "render/scene/view.h"
#include "vision/picture/picture.h"

/// How large a scene is and where it stands.

namespace repose::render {

/// Box round all grains, along axes whose rows are given; empty without grains. Exact for spheres
/// and surfaces, whichever is larger. Of a scene with a setting, the box round its extent.
Eigen::AlignedBox3d grain_bounds(const Scene& scene, const Eigen::Matrix3d& axes);

/// What the grains lie on: height of the highest level wall face below the grains' middle, m. None
/// without such a wall.
std::optional<double> ground_m(const Scene& scene);

/// Where the ground meets the upright plane through the grains' middle that faces the camera, at
/// the picture's left and right edge. None when nothing level is below the grains, or when it
/// cannot be seen.
std::optional<vision::Segment> ground_in_picture(const Scene& scene, const View& view);

}  // namespace repose::render
