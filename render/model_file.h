#pragma once

#include <cstddef>
#include <vector>

#include "render/scene/scene.h"
#include "render/scene/style.h"

namespace repose::render {

/// The scene as a binary glTF 2.0 file (.glb): metres, y upwards as glTF has it, -z the way the
/// camera of azimuth 0 looks. A surface is there once for each shape; each grain is a node that
/// places it. Grains are named by their numbers.
std::vector<std::byte> glb_of(const Scene& scene, Shown shown);

}  // namespace repose::render
