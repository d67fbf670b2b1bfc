#include "render/silhouette/mask.h"

#include <memory>

#include "render/gl/lens.h"

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

std::vector<std::uint8_t> MaskPainter::paint(const View& view, const Stage& stage,
                                             bool walls_hide) {
  const auto [width, height] = view.size;
  const gl::Texture colour(gl_, gl::PixelFormat::grey8, width, height);
  const auto depth = walls_hide
                         ? std::make_unique<gl::Texture>(gl_, gl::PixelFormat::depth, width, height)
                         : nullptr;
  const gl::Target target(gl_, &colour, depth.get());
  target.use();
  gl_.Disable(GL_BLEND);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | (walls_hide ? GL_DEPTH_BUFFER_BIT : 0U));
  (walls_hide ? gl_.Enable : gl_.Disable)(GL_DEPTH_TEST);
  program_.use();
  set_lens(program_, view, stage, 1);
  program_.set("value", 1.0);
  draw_batches(gl_, stage.grains);
  if (walls_hide) {
    program_.set("value", 0.0);
    draw_batches(gl_, stage.walls);
  }
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(width) *
                                 static_cast<std::size_t>(height));
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.ReadPixels(0, 0, width, height, GL_RED, GL_UNSIGNED_BYTE, mask.data());
  return mask;
}

}  // namespace repose::render
