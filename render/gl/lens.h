#pragma once

#include <array>
#include <string>

#include "render/gl/objects.h"
#include "render/gl/scene_uploader.h"
#include "render/scene/view.h"

namespace repose::render {

/// How one exposure deviates from the ideal picture.
struct Exposure {
  std::array<double, 2> shift_px = {0, 0};  ///< of the picture
  std::array<double, 2> lens_m = {0, 0};    ///< where the light passes through the lens
};

/// GLSL: `vec4 in_picture(vec3 p)` for a point on the stage, and the uniforms it needs.
const std::string& lens_source();

/// Sets those uniforms. Points at depth `focus_m` do not move in the picture when the lens is
/// shifted.
void set_lens(const gl::Program& program, const View& view, const Stage& stage, double focus_m,
              const Exposure& exposure = {});

/// Visible depths, m from the eye; they include the whole scene.
struct DepthRange {
  double nearest_m;
  double farthest_m;
};
DepthRange depth_range(const View& view, const Stage& stage);

/// Culls back faces of closed surfaces; draws both sides of open ones.
void set_culling(const gl::Functions& gl, bool is_closed);

/// Draws batches with the current program.
void draw_batches(const gl::Functions& gl, const std::vector<Batch>& batches);

}  // namespace repose::render
