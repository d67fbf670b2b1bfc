#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "dem/shape/clump/clump_shape.h"
#include "dem/shape/clump/surface.h"

namespace repose::dem {

/// Moves and sizes spheres until their union's surface runs through given points.
///
///     cost = (sum f(p)^2 + sum min(0, f(g) - h/3)^2) / n
///     f(x) = min over the spheres of |x - c| - r
///
///     p     n points of the surface      m    c, r  centres and radii    m
///     g, h  points outside, and how far from the surface they are    m
///
/// f is a point's distance from the union if outside it, and minus its depth in the deepest sphere
/// if inside. The outside points keep spheres from filling a dent from outside, where they would
/// also touch the surface; small bulges do not reach them. Each point acts on its nearest sphere
/// only, so that the normal equations decouple into 4 x 4 blocks; steps use Levenberg-Marquardt
/// damping. If no outside point is active, the mean of f over each sphere's points is 0 at the
/// optimum: to first order, the union has the body's volume. Source: Madsen, Nielsen & Tingleff,
/// Methods for non-linear least squares problems (2004), section 3.2. Proved by
/// tests/dem/shape_sphere_fit_test.cpp.
class SphereFit {
 public:
  /// A point outside the body.
  struct Guard {
    Vector point = Vector::Zero();
    double height_m = 0;
  };

  /// No sphere becomes smaller than `smallest_radius_m`.
  SphereFit(const std::vector<SurfaceSample>& samples, const std::vector<Guard>& guards,
            double smallest_radius_m);

  /// Improves the spheres in place. @return the cost reached, m^2.
  double improve(std::vector<ClumpSphere>& spheres, int iterations) const;

  /// Errors at each point for a set of spheres: first the samples, then the guards.
  struct Reading {
    Eigen::ArrayXd error;         ///< f, or min(0, f - h/3), m
    Eigen::ArrayXd second_error;  ///< the same without the nearest sphere, m
    Eigen::ArrayXd sphere;        ///< index of the nearest one
    double cost = 0;              ///< m^2
  };
  Reading read(const std::vector<ClumpSphere>& spheres) const;

  std::size_t samples() const { return samples_; }

 private:
  std::size_t samples_;
  Eigen::ArrayXd x_, y_, z_;
  Eigen::ArrayXd least_;  ///< f at which the error is 0, m
  double smallest_radius_;
};

/// Fits `count` spheres to the surface, starting with those given, then escapes local minima: a
/// dispensable sphere is moved to where the error is largest and all are refitted; improvements are
/// kept. Ends when no such move helps, or after a number of attempts that depends only on the
/// number of spheres.
void relocate_and_fit(const SphereFit& fit, const std::vector<SurfaceSample>& samples,
                      std::size_t count, std::vector<ClumpSphere>& spheres);

}  // namespace repose::dem
