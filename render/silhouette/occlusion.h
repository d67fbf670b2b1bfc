#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/scene.h"
#include "render/scene/style.h"
#include "render/scene/view.h"
#include "render/silhouette/mask.h"

namespace repose::render {

/// Radius of a ball about the centre of mass that lies wholly inside what is drawn, m; 0 if none.
double core_radius_m(const dem::ClumpShape& shape, Shown shown);

/// The part of a silhouette that needs no drawing.
struct Occlusion {
  std::vector<std::uint8_t> mask;    ///< 255 where a grain's core projects, else 0
  CoveredArea covered;               ///< by the mask
  std::vector<PlacedGrain> visible;  ///< the others project wholly onto cores
};

/// Exact: all pixels that an omitted grain could cover are already set in the mask.
/// @param view  with parallel rays
Occlusion occluded_part(const Scene& scene, const View& view, Shown shown);

}  // namespace repose::render
