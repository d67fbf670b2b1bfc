#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "calibrate/fit/hyperparameters.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/plausible.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/surrogate.h"

/// Where a next run tells most.
namespace repose::calibrate {

/// Which of the `candidates` to run next, `count` of them, some perhaps twice.
///
/// One by one, each time the place whose run would lower the surrogates' variances over all
/// candidates most, each surrogate's in units of `weights`: Cohn (1996), Neural Networks 9, 1071;
/// for Gaussian processes Seo, Wallat, Graepel, Obermayer (2000). A run without chance is never
/// repeated. Proved by BestPlaces.* in tests/calibrate.
/// @param enough  fewer are chosen where after these no surrogate's mean variance is above
/// @param accepts  asked of each before it is chosen; one that is not accepted is passed over from
///   then on. None: all are
std::vector<std::size_t> best_places(const std::vector<Surrogate>& surrogates,
                                     const std::vector<double>& weights,
                                     const std::vector<Point>& candidates, std::size_t count,
                                     double enough = 0,
                                     const std::function<bool(std::size_t)>& accepts = {});

/// A surrogate's mean variance at the plausible sets, in that of the measured mean, from which on
/// runs are worth their while: it adds 3 % to sigma.
inline constexpr double kKnownWell = .06;
inline constexpr int kSpreadEvery = 8;  ///< one of so many runs looks elsewhere

/// A run to be made.
struct ChosenRun {
  std::size_t place = 0;  ///< among the candidates
  RunKind kind = RunKind::full;
};

/// What a run of an experiment costs, s.
struct RunCosts {
  double full_s = 0;
  double coarse_s = 0;
};

/// As best_places(), of an experiment that has coarse runs, too: each time the run, full or coarse,
/// that lowers the variances of full ones most for what it costs, until `seconds` are spent. The
/// last may take longer, where `most_seconds` allow it.
std::vector<ChosenRun> best_runs(const std::vector<Surrogate>& surrogates,
                                 const std::vector<double>& weights,
                                 const std::vector<Point>& candidates, const RunCosts& costs,
                                 double seconds, double most_seconds);

/// That mean variance.
double unknown_fraction(const Misfit& misfit, const PosteriorSamples& sets, std::size_t observable);

/// Places that a next run may be at, where sets of coefficients are plausible.
std::vector<Point> candidate_places(const PosteriorSamples& sets);

}  // namespace repose::calibrate
