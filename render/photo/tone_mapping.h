#pragma once

#include <vector>

#include "render/scene/style.h"
#include "vision/picture/picture.h"

namespace repose::render {

/// Linear light, red green blue a pixel, rows from the top; 1 is white paper in full light.
struct Light {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;
};

/// sRGB to light, each channel. Source: IEC 61966-2-1:1999, section 5.2.
Colour linear(const Colour& colour);

/// What a camera makes of the light: fall-off to the corners, blur of lens and sensor, noise that
/// grows with the root of the light, and the curve of sRGB with a soft shoulder. The style's seed
/// gives the noise.
vision::Picture tone_mapped(const Light& light, const PhotoStyle& style);

}  // namespace repose::render
