#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/misfit.h"
#include "calibrate/fit/plausible.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {

/// Points that fill each experiment's own parameters evenly; with chance, every fifth twice, to
/// learn how much the seed does.
std::vector<Job> first_round(const Problem& problem);

// A study's first round comes in two parts, where some experiments follow others: those that cost
// much, and depend on all that a cheap one depends on and on more besides. See THEORY.md, "Rounds".

bool has_followers(const Problem& problem);

/// Of the experiments that follow none: their jobs of the first round.
std::vector<Job> leading_jobs(const Problem& problem);

/// Of the others: as many as in the first round, where those before leave their parameters
/// plausible; one in eight anywhere.
std::vector<Job> following_jobs(const Problem& problem, const std::vector<Run>& leading);

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

/// That mean variance.
double unknown_fraction(const Misfit& misfit, const PosteriorSamples& sets, std::size_t observable);

/// Places that a next run may be at, where sets of coefficients are plausible.
std::vector<Point> candidate_places(const PosteriorSamples& sets);

/// The rounds of a study, as far as its runs go.
struct Rounds {
  std::vector<RoundSummary> complete;
  std::vector<Job> missing;  ///< of the round that is not complete; empty: the study has ended
};

/// Plans the study again from the beginning: the first round from the problem, each later one from
/// the runs of those before it. So the rounds depend on what the runs gave and on nothing else.
Rounds reconstruct_rounds(const Problem& problem, const std::vector<Run>& runs);

}  // namespace repose::calibrate
