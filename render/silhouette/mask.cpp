#include "render/silhouette/mask.h"

#include <memory>

#include "render/gl/lens.h"
#include "render/silhouette/uncovered.h"

namespace repose::render {
namespace {

const char* const kVertex = R"(
in vec3 position;
in vec4 row_x, row_y, row_z;
void main() {
  vec4 p = vec4(position, 1.0);
  gl_Position = in_picture(vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p)));
}
)";

const char* const kFragment = R"(#version 330 core
uniform float value;
out vec4 colour;
void main() { colour = vec4(value); }
)";

}  // namespace

MaskPainter::MaskPainter(const gl::Functions& gl)
    : gl_(gl), program_(gl, lens_source() + kVertex, kFragment, kAttributes) {}

template <class Draw>
std::vector<std::uint8_t> MaskPainter::paint(const View& view, const Stage& stage, bool has_depth,
                                             Draw draw) {
  const auto [width, height] = view.size;
  const gl::Texture colour(gl_, gl::PixelFormat::grey8, width, height);
  const auto depth = has_depth
                         ? std::make_unique<gl::Texture>(gl_, gl::PixelFormat::depth, width, height)
                         : nullptr;
  const gl::Target target(gl_, &colour, depth.get());
  target.use();
  gl_.Disable(GL_BLEND);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | (has_depth ? GL_DEPTH_BUFFER_BIT : 0U));
  (has_depth ? gl_.Enable : gl_.Disable)(GL_DEPTH_TEST);
  program_.use();
  set_lens(program_, view, stage, 1);
  program_.set("value", 1.0);
  draw();
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(width) *
                                 static_cast<std::size_t>(height));
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.ReadPixels(0, 0, width, height, GL_RED, GL_UNSIGNED_BYTE, mask.data());
  return mask;
}

std::vector<std::uint8_t> MaskPainter::paint(const View& view, const Stage& stage) {
  return paint(view, stage, true, [&] {
    draw_batches(gl_, stage.grains);
    program_.set("value", 0.0);
    draw_batches(gl_, stage.walls);
  });
}

std::vector<std::uint8_t> MaskPainter::paint_grains(const View& view, const Stage& stage) {
  return paint(view, stage, false, [&] { draw_batches(gl_, stage.grains); });
}

std::vector<std::uint8_t> MaskPainter::paint_uncovered(const View& view, const Stage& stage,
                                                       const CoveredArea& covered) {
  return paint(view, stage, false, [&] { draw_uncovered(gl_, view, stage, covered); });
}

}  // namespace repose::render
