#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/scene.h"
#include "render/scene/style.h"
#include "render/scene/view.h"
#include "vision/picture/picture.h"

namespace repose::render {

/// Upper edge of all grains at the centre of each pixel column that shows any, left to right,
/// within the picture's width. Uses full meshes, and spheres finer than any picture.
std::vector<vision::Point> upper_edge(const Scene& scene, const View& view, Shown shown);

/// The grains' mask as a picture: black on white.
vision::Picture silhouette_of(const Scene& scene, const View& view, const SilhouetteStyle& style,
                              const std::vector<std::uint8_t>& grain_mask);

}  // namespace repose::render
