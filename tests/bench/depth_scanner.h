#pragma once

#include <cstdint>
#include <vector>

#include "base/polygon_file.h"
#include "render/scene/scene.h"

namespace repose::bench {

/// A depth camera that is carried around a heap, and its errors.
struct DepthScanner {
  int stands = 7;                 ///< evenly around, the last one above
  int width = 400, height = 300;  ///< pixels of each depth map
  double noise_m = 0.4e-3;        ///< standard deviation of each depth
  double flying = 0.01;           ///< fraction of pixels at a wrong depth along their ray
  double turn_rad = 1e-3;         ///< standard deviation of each stand's registration, per axis,
  double shift_m = 0.3e-3;        ///< ... in rotation about the heap's middle, and in position
  std::uint64_t seed = 1;
};

/// Its view of a scene's spheres on the plane z = 0, in millimetres and in a random orientation:
/// each stand's depth map, as points moved by that stand's registration error.
std::vector<base::Corner> scanned(const render::Scene& scene, const DepthScanner& scanner);

/// The scene's surface from straight above, without any error, mm: a point in each cell of a grid.
struct ExactSurface {
  std::vector<base::Corner> points;
  double volume_ml = 0;  ///< below the surface, of all grains together
};
ExactSurface surface_from_above(const render::Scene& scene);

}  // namespace repose::bench
