#pragma once

#include "render/renderer.h"
#include "tests/support/heap_palette.h"

namespace repose::bench {

/// Shared by all rendered photographs.
inline constexpr render::PictureSize kPhotograph{1280, 853};
inline constexpr double kFilm_mm = 36;  // wide, as PerspectiveCamera::focal_mm has it

inline render::Colour colour_of(const testing::Color& color) { return {color.r, color.g, color.b}; }

}  // namespace repose::bench
