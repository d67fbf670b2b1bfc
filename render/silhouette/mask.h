#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/gl/functions.h"
#include "render/gl/objects.h"
#include "render/gl/scene_uploader.h"
#include "render/scene/camera.h"
#include "render/scene/view.h"
#include "vision/picture/picture.h"

namespace repose::render {

/// Sets all pixels whose centres lie in a disc to 255.
void cover_disc(std::vector<std::uint8_t>& mask, const PictureSize& size,
                const vision::Point& middle, double radius_px);

/// Half-open ranges of pixels: first to end - 1.
struct PixelBox {
  int first_x = 0;
  int end_x = 0;
  int first_y = 0;
  int end_y = 0;
};

/// Tests whether all pixels of any part of a picture are covered.
class CoveredArea {
 public:
  /// @param mask  0 where a pixel is not covered
  CoveredArea(const std::vector<std::uint8_t>& mask, const PictureSize& size);

  /// Only pixels inside the picture count; true if there are none.
  bool hides_box(const PixelBox& box) const;
  bool hides_disc(const vision::Point& middle, double radius_px) const;

 private:
  /// Number of covered pixels above and to the left of a pixel corner.
  std::uint32_t& before(int y, int x) { return before_[at(y, x)]; }
  std::uint32_t before(int y, int x) const { return before_[at(y, x)]; }
  std::size_t at(int y, int x) const {
    return static_cast<std::size_t>(y) * (static_cast<std::size_t>(size_.width) + 1) +
           static_cast<std::size_t>(x);
  }

  PictureSize size_;
  std::vector<std::uint32_t> before_;
};

/// Draws which pixels show grains: one byte per pixel, 255 if its centre shows one.
class MaskPainter {
 public:
  explicit MaskPainter(const gl::Functions& gl);

  /// Walls in front of grains hide them.
  std::vector<std::uint8_t> paint(const View& view, const Stage& stage);
  /// Without walls.
  std::vector<std::uint8_t> paint_grains(const View& view, const Stage& stage);
  /// The same with parallel rays, but covered pixels may be left blank.
  std::vector<std::uint8_t> paint_uncovered(const View& view, const Stage& stage,
                                            const CoveredArea& covered);

 private:
  template <class Draw>
  std::vector<std::uint8_t> paint(const View& view, const Stage& stage, bool has_depth, Draw draw);

  const gl::Functions& gl_;
  gl::Program program_;
};

/// With the current program, draws only the grains' triangles that may reach uncovered pixels: in a
/// heap, a tenth of those of its visible grains. Uncovered pixels look as if all had been drawn.
/// @param view  with parallel rays
void draw_uncovered(const gl::Functions& gl, const View& view, const Stage& stage,
                    const CoveredArea& covered);

}  // namespace repose::render
