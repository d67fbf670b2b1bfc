#pragma once

#include "render/gl/functions.h"
#include "render/gl/scene_uploader.h"
#include "render/scene/view.h"
#include "render/silhouette/covered_area.h"

namespace repose::render {

/// Draws the grains' triangles, with the program in use, that may reach pixels which are not
/// covered: of a heap a tenth of those of its visible grains. Pixels that are not covered look as
/// if all had been drawn.
/// @param view  with parallel rays
void draw_uncovered(const gl::Functions& gl, const View& view, const Stage& stage,
                    const CoveredArea& covered);

}  // namespace repose::render
