#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "render/scene/scene.h"
#include "render/scene/view.h"
#include "vision/picture/picture.h"

/// Size and position of a scene.

namespace repose::render {

/// Bounding box of all grains along the axes in the rows of `axes`; empty without grains. Exact for
/// spheres and surfaces, whichever is larger. For a scene with a setting, the box around its
/// extent.
Eigen::AlignedBox3d grain_bounds(const Scene& scene, const Eigen::Matrix3d& axes);

/// Height of the highest level wall face below the grains' middle, on which they lie, m.
/// std::nullopt without such a wall.
std::optional<double> ground_m(const Scene& scene);

/// Where the ground meets the vertical plane through the grains' middle that faces the camera, at
/// the picture's left and right edges. std::nullopt if nothing level is below the grains, or it is
/// not visible.
std::optional<vision::Segment> ground_in_picture(const Scene& scene, const View& view);

}  // namespace repose::render
