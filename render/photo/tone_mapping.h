#pragma once

#include <vector>

#include "render/scene/style.h"
#include "vision/picture/picture.h"

namespace repose::render {

/// Linear light: red, green, blue per pixel, rows from the top; 1 is white paper in full light.
struct Light {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;
};

/// sRGB to linear light, per channel. Source: IEC 61966-2-1:1999, section 5.2.
Colour linear(const Colour& colour);

/// A camera's response to the light: fall-off towards the corners, blur of lens and sensor, noise
/// that grows with the square root of the light, and the sRGB curve with a soft shoulder. The
/// style's seed and frame determine the noise.
vision::Picture tone_mapped(const Light& light, const PhotoStyle& style);

}  // namespace repose::render
