#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "calibrate/fit/hyperparameters.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/plausible.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/surrogate.h"

/// The most informative places for further runs.
namespace repose::calibrate {

/// Selects which `count` of the `candidates` to run next; some may be selected twice.
///
/// Greedy: each time the place whose run would reduce the surrogates' variances over all candidates
/// most, each surrogate weighted by `weights`: Cohn (1996), Neural Networks 9, 1071; for Gaussian
/// processes Seo, Wallat, Graepel, Obermayer (2000). A deterministic run is never repeated. Proved
/// by BestPlaces.* in tests/calibrate.
/// @param enough  stops early once no surrogate's mean variance is above this
/// @param accepts  called before a place is selected; if false, it is skipped from then on
std::vector<std::size_t> best_places(const std::vector<Surrogate>& surrogates,
                                     const std::vector<double>& weights,
                                     const std::vector<Point>& candidates, std::size_t count,
                                     double enough = 0,
                                     const std::function<bool(std::size_t)>& accepts = {});

/// A surrogate's mean variance at the plausible sets, relative to that of the measured mean, above
/// which runs are worthwhile: it adds 3 % to sigma.
inline constexpr double kKnownWell = .06;
inline constexpr int kSpreadEvery = 8;  ///< one in this many runs explores elsewhere

/// A run to be made.
struct ChosenRun {
  std::size_t place = 0;  ///< among the candidates
  RunKind kind = RunKind::full;
};

/// Cost of one run of an experiment, s.
struct RunCosts {
  double full_s = 0;
  double coarse_s = 0;
};

/// As best_places(), for an experiment that also has coarse runs: each time the run, full or
/// coarse, that reduces the variances of full ones most for its cost, until `seconds` are spent.
/// The last may take longer, up to `most_seconds`.
std::vector<ChosenRun> best_runs(const std::vector<Surrogate>& surrogates,
                                 const std::vector<double>& weights,
                                 const std::vector<Point>& candidates, const RunCosts& costs,
                                 double seconds, double most_seconds);

/// That mean variance.
double unknown_fraction(const Misfit& misfit, const PosteriorSamples& sets, std::size_t observable);

/// Places for the next runs, based on the plausible sets of coefficients.
std::vector<Point> candidate_places(const PosteriorSamples& sets);

}  // namespace repose::calibrate
