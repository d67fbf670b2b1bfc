#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "dem/shape/clump/clump_shape.h"
#include "dem/shape/clump/surface.h"

namespace repose::dem {

/// Moves and sizes spheres until their union's surface runs through given points.
///
///     cost = mean f(p)^2 + mean min(0, f(g) - h/3)^2        f(x) = min over the spheres of |x - c|
///     - r
///
///     p     points of the surface        m    c, r  centres and radii    m
///     g, h  points outside, and how far from the surface they are    m
///
/// f is the distance of a point from the union when it is outside of it, and how deep it is in one
/// sphere when it is inside. The points outside keep spheres from lying in a dent from outside,
/// where they would touch the surface as well; small bulges do not reach them. Each point pulls at
/// the sphere it is nearest to, so that the normal equations fall apart into 4 x 4 blocks; steps
/// are damped after Levenberg and Marquardt. Where no point outside pulls, the mean of f over each
/// sphere's points is 0 at the optimum: to first order, the union has the body's volume. Source:
/// Madsen, Nielsen & Tingleff, Methods for non-linear least squares problems (2004), section 3.2.
/// Proved by tests/dem/shape_sphere_fit_test.cpp.
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

  /// What each point says about a set of spheres: first the samples, then the guards.
  struct Reading {
    Eigen::ArrayXd error;         ///< f, or min(0, f - h/3), m
    Eigen::ArrayXd second_error;  ///< the same without the nearest sphere, m
    Eigen::ArrayXd sphere;        ///< which is the nearest one
    double cost = 0;              ///< m^2
  };
  Reading read(const std::vector<ClumpSphere>& spheres) const;

  std::size_t samples() const { return samples_; }

 private:
  std::size_t samples_;
  Eigen::ArrayXd x_, y_, z_;
  Eigen::ArrayXd least_;  ///< error where f is this, m
  double smallest_radius_;
};

/// Fits `count` spheres to the surface, starting with those given, then gets them out of local
/// minima: a sphere that the fit can spare is put where the error is largest and all are fitted
/// again; what is better stays. Ends when no such move helps, or after a number of attempts that
/// depends on the number of spheres alone.
void relocate_and_fit(const SphereFit& fit, const std::vector<SurfaceSample>& samples,
                      std::size_t count, std::vector<ClumpSphere>& spheres);

}  // namespace repose::dem
