#pragma once

#include <cstddef>
#include <vector>

#include "render/scene/scene.h"
#include "render/scene/style.h"

namespace repose::render {

/// The scene as a binary glTF 2.0 file (.glb): metres, y upwards as glTF requires; a camera at
/// azimuth 0 looks along -z. Each shape's surface is stored once; each grain is a node that places
/// it. Grains are named by their numbers.
std::vector<std::byte> glb_of(const Scene& scene, Shown shown);

}  // namespace repose::render
