#pragma once

#include "render/photo/light.h"
#include "render/scene/style.h"
#include "vision/picture/picture.h"

namespace repose::render {

/// sRGB to light, each channel. Source: IEC 61966-2-1:1999, section 5.2.
Colour linear(const Colour& colour);

/// What a camera makes of the light: fall-off to the corners, blur of lens and sensor, noise that
/// grows with the root of the light, and the curve of sRGB with a soft shoulder. The style's seed
/// gives the noise.
vision::Picture tone_mapped(const Light& light, const PhotoStyle& style);

}  // namespace repose::render
