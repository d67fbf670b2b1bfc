#include "render/gl/lens.h"

#include <algorithm>

namespace repose::render {

// A picture's first row is OpenGL's lowest: y stays downwards, and winding order is reversed.
const std::string& lens_source() {
  static const std::string source = R"(#version 330 core
uniform mat3 axes;           // right, down, into the picture
uniform vec3 eye;            // on the stage
uniform bool is_perspective;
uniform vec2 scale;          // picture halves to a metre, or to a focal length
uniform vec2 shift;          // picture halves
uniform vec2 aperture;       // metres at the eye, to a metre of depth
uniform float focus;         // depth
uniform vec3 distortion;     // k1, k2, greatest r
uniform vec2 depth_map;

float distorted(float r) {
  float inside = min(r, distortion.z), r2 = inside * inside;
  float slope = 1.0 + 3.0 * distortion.x * r2 + 5.0 * distortion.y * r2 * r2;
  return inside * (1.0 + distortion.x * r2 + distortion.y * r2 * r2) + (r - inside) * slope;
}

vec4 in_picture(vec3 point) {
  vec3 p = axes * (point - eye);
  p.xy += aperture * (p.z - focus);
  if (!is_perspective) {
    return vec4(p.xy * scale + shift, depth_map.x * p.z + depth_map.y, 1.0);
  }
  float factor = 1.0;
  if (distortion.xy != vec2(0.0) && p.z > 0.0) {
    float r = length(p.xy) / p.z;
    if (r > 0.0) factor = distorted(r) / r;
  }
  return vec4(factor * p.xy * scale + shift * p.z, depth_map.x * p.z + depth_map.y, p.z);
}
)";
  return source;
}

DepthRange depth_range(const View& view, const Stage& stage) {
  constexpr double kFar = 200;  // in units of Stage::radius_m: backdrops and slabs
  if (!view.is_perspective) return {-kFar * stage.radius_m, kFar * stage.radius_m};
  constexpr double kNear = 1e-3;
  const double depth = view.in_camera(stage.origin).norm();
  return {kNear * depth, depth + kFar * stage.radius_m};
}

void set_lens(const gl::Program& program, const View& view, const Stage& stage, double focus_m,
              const Exposure& exposure) {
  std::array<double, 9> rows{};
  for (int k = 0; k < 9; ++k) rows[static_cast<std::size_t>(k)] = view.axes(k / 3, k % 3);
  program.set("axes", rows);
  const dem::Vector eye = view.eye - stage.origin;
  program.set("eye", std::array{eye.x(), eye.y(), eye.z()});
  program.set("is_perspective", view.is_perspective ? 1 : 0);
  const double half_width = .5 * view.size.width, half_height = .5 * view.size.height;
  program.set("scale", std::array{view.scale / half_width, view.scale / half_height});
  program.set("shift",
              std::array{exposure.shift_px[0] / half_width, exposure.shift_px[1] / half_height});
  program.set("aperture", std::array{exposure.lens_m[0] / focus_m, exposure.lens_m[1] / focus_m});
  program.set("focus", focus_m);
  program.set("distortion", std::array{view.k1, view.k2, view.greatest_r});
  const auto [nearest, farthest] = depth_range(view, stage);
  const double span = farthest - nearest;
  if (view.is_perspective) {
    program.set("depth_map",
                std::array{(farthest + nearest) / span, -2 * farthest * nearest / span});
  } else {
    program.set("depth_map", std::array{2 / span, -(farthest + nearest) / span});
  }
}

void set_culling(const gl::Functions& gl, bool is_closed) {
  gl.FrontFace(GL_CW);
  gl.CullFace(GL_BACK);
  (is_closed ? gl.Enable : gl.Disable)(GL_CULL_FACE);
}

void draw_batches(const gl::Functions& gl, const std::vector<Batch>& batches) {
  for (const Batch& batch : batches) {
    set_culling(gl, batch.is_closed);
    batch.shape->draw(batch.instances, kInstanceParts);
  }
}

}  // namespace repose::render
