#pragma once

#include <cstdint>
#include <vector>

#include "render/gl/objects.h"
#include "render/gl/scene_uploader.h"
#include "render/scene/view.h"

namespace repose::render {

/// Draws which pixels show grains.
class MaskPainter {
 public:
  explicit MaskPainter(const gl::Functions& gl);

  /// A byte a pixel, 255 where the pixel's middle shows a grain.
  /// @param walls_hide  whether walls before the grains hide them
  std::vector<std::uint8_t> paint(const View& view, const Stage& stage, bool walls_hide);

 private:
  const gl::Functions& gl_;
  gl::Program program_;
};

}  // namespace repose::render
