#pragma once

#include <optional>

#include "render/scene/scene.h"
#include "render/scene/view.h"
#include "vision/picture/picture.h"

namespace repose::render {

/// Where the ground meets the upright plane through the grains' middle that faces the camera, at
/// the picture's left and right edge. None when nothing level is below the grains, or when it
/// cannot be seen.
std::optional<vision::Segment> ground_in_picture(const Scene& scene, const View& view);

}  // namespace repose::render
