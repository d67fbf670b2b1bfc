#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/polygon_file.h"

/// Scans of known surfaces.
namespace repose::testing {

/// Height above the ground at a place on it.
using HeightOver = std::function<double(double x, double y)>;

HeightOver cone_surface(double angle_deg, double height);

/// Volume of that cone, in cubic units of `height`.
double cone_volume(double angle_deg, double height);

struct ScanDraft {
  HeightOver surface;
  double half_side = 260;  ///< of the square that is scanned
  std::size_t points = 100'000;
  double noise = 0.3;  ///< standard deviation of each coordinate
  std::uint64_t seed = 1;
};

/// Points at random places in a square around the origin, z up.
std::vector<base::Corner> drawn_scan(const ScanDraft& draft);

/// Adds points at random places in a box of that half side.
void add_outliers(std::vector<base::Corner>& points, std::size_t count, double half_side,
                  std::uint64_t seed = 7);

/// The points for which `keeps` is true.
std::vector<base::Corner> kept(const std::vector<base::Corner>& points,
                               const std::function<bool(const base::Corner&)>& keeps);

/// Rotated by 130 degrees about (1, 2, 3), scaled and moved.
std::vector<base::Corner> turned(std::vector<base::Corner> points, double scale = 1);

/// Binary PLY.
std::string ply_of(const std::vector<base::Corner>& points,
                   const std::vector<std::array<std::uint32_t, 3>>& triangles = {});

}  // namespace repose::testing
