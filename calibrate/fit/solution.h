#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "calibrate/fit/misfit.h"
#include "calibrate/fit/plausible.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/problem.h"

namespace repose::calibrate {

struct Minimum {
  Point point;
  double chi2 = 0;       ///< Misfit::chi2 there
  double objective = 0;  ///< with the small residuals that break ties
};

/// Descends from `start` within the box (Ceres, Levenberg-Marquardt with bounds); coordinate `held`
/// stays fixed.
Minimum minimum_from(const Misfit& misfit, Point start, std::optional<std::size_t> held = {});

/// The lowest of the minima from `extra` starts and the best dozen of a spread of points.
Minimum least_minimum(const Misfit& misfit, const std::vector<Point>& extra);

/// Chi-squared of one degree of freedom at 95 %: how far a profile may rise inside the interval.
inline constexpr double kChi2Limit = 3.841458820694124;

/// The best fit as a function of one coordinate.
struct Profile {
  std::vector<Minimum> minima;  ///< by increasing coordinate, including the best fit
  double low = 0;               ///< the interval, in the unit box
  double high = 1;
  double rise = kChi2Limit;  ///< of chi2 at the ends of the interval: Misfit::interval_limit()
};

/// Follows the best fit with coordinate `held` moved to both sides until chi2 has risen by
/// Misfit::interval_limit() or a bound is met: Venzon and Moolgavkar (1988), Appl. Statist. 37, 87.
/// `plausible` points start searches of their own and, if within the limit, belong to the interval
/// even if the path to them does not. Proved by JointFit.* in tests/calibrate.
Profile profile_along(const Misfit& misfit, const Minimum& best, std::size_t held,
                      const std::vector<Point>& plausible);

/// Everything that the fit found, in the unit box.
struct Solution {
  Misfit misfit;
  Minimum best;
  PosteriorSamples sets;
  std::vector<Profile> profiles;  ///< per coordinate
  /// Least chi-square with the model's error as stated beforehand, and its degrees of freedom.
  double stated_chi2 = 0;
  Freedom stated_freedom;
};

/// Learns the surrogates, finds the best fit, and profiles it along every coordinate; restarts if
/// that finds a better one. If the model's error has to be larger than stated, it is scaled up.
/// `runs` in_order.
Solution solve(const Problem& problem, const std::vector<Run>& runs);

/// Points that fit as well as the best (chi2 within kChi2Limit) and lie far from it and from each
/// other, the farthest first; empty if all such points are close together.
std::vector<Minimum> equivalence_family(const Solution& solution);

/// Whether they are so close in the unit box that a family includes only one of them.
bool are_alike(const Point& a, const Point& b);

}  // namespace repose::calibrate
