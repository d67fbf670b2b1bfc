#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dem/shape/clump/clump_shape.h"
#include "dem/shape/scan/mesh.h"

namespace repose::dem {

struct SurfaceSample {
  Vector point = Vector::Zero();
  Vector normal = Vector::Zero();  ///< outwards, unit
};

/// Points spread evenly over a surface, each for the same area; always the same ones.
std::vector<SurfaceSample> sample_surface(const Mesh& mesh, std::size_t count);

struct WeightedPoint {
  Vector point = Vector::Zero();
  double area = 0;
};

/// Points spread evenly over what is to be seen from outside of a union of spheres: about `count`
/// in all, as many for each area.
std::vector<WeightedPoint> sample_union(std::span<const ClumpSphere> spheres, std::size_t count);

}  // namespace repose::dem
