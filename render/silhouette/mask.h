#pragma once

#include <cstdint>
#include <vector>

#include "render/gl/objects.h"
#include "render/gl/scene_uploader.h"
#include "render/scene/view.h"
#include "render/silhouette/covered_area.h"

namespace repose::render {

/// Draws which pixels show grains: a byte a pixel, 255 where the pixel's middle shows one.
class MaskPainter {
 public:
  explicit MaskPainter(const gl::Functions& gl);

  /// Walls before the grains hide them.
  std::vector<std::uint8_t> paint(const View& view, const Stage& stage);
  /// Without walls.
  std::vector<std::uint8_t> paint_grains(const View& view, const Stage& stage);
  /// The same, seen with parallel rays; but what is covered may be left out.
  std::vector<std::uint8_t> paint_uncovered(const View& view, const Stage& stage,
                                            const CoveredArea& covered);

 private:
  template <class Draw>
  std::vector<std::uint8_t> paint(const View& view, const Stage& stage, bool has_depth, Draw draw);

  const gl::Functions& gl_;
  gl::Program program_;
};

}  // namespace repose::render
