#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/scene.h"
#include "render/scene/style.h"
#include "render/scene/view.h"
#include "vision/picture/picture.h"

namespace repose::render {

/// The grains' mask as a picture: black on white.
vision::Picture silhouette_of(const Scene& scene, const View& view, const SilhouetteStyle& style,
                              const std::vector<std::uint8_t>& grain_mask);

}  // namespace repose::render
