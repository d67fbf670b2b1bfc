#pragma once

#include <array>
#include <string>

#include "render/gl/objects.h"
#include "render/gl/scene_uploader.h"
#include "render/scene/view.h"

namespace repose::render {

/// How one exposure differs from the ideal picture.
struct Exposure {
  std::array<double, 2> shift_px = {0, 0};  ///< of the picture
  std::array<double, 2> lens_m = {0, 0};    ///< of the point of the lens that light goes through
};

/// GLSL: `vec4 in_picture(vec3 p)` for a point on the stage, with the uniforms it needs.
const std::string& lens_source();

/// Sets those uniforms. What lies at `focus_m` from the eye stays where it is however the lens is
/// shifted.
void set_lens(const gl::Program& program, const View& view, const Stage& stage, double focus_m,
              const Exposure& exposure = {});

/// Depths that can be seen, m from the eye, all of the scene among them.
struct DepthRange {
  double nearest_m;
  double farthest_m;
};
DepthRange depth_range(const View& view, const Stage& stage);

/// Leaves out what is seen from behind, which another side hides; draws both sides of what is open.
void set_culling(const gl::Functions& gl, bool is_closed);

/// Draws batches with the program in use.
void draw_batches(const gl::Functions& gl, const std::vector<Batch>& batches);

}  // namespace repose::render
