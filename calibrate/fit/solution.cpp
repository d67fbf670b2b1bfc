#include "calibrate/fit/solution.h"

#include "calibrate/fit/model_error.h"

namespace repose::calibrate {
namespace {

constexpr double kBetter = .01;  // in chi2: worth beginning again
constexpr int kMaxTurns = 4;

std::vector<Profile> profiles_of(const Misfit& misfit, const Minimum& best,
                                 const PlausibleSets& sets) {
  std::vector<Profile> profiles;
  for (std::size_t j = 0; j < misfit.dimensions(); ++j) {
    profiles.push_back(profile_along(misfit, best, j, sets.points));
  }
  return profiles;
}

/// The least minimum on any profile.
Minimum least_of(const std::vector<Profile>& profiles, Minimum least) {
  for (const Profile& profile : profiles) {
    for (const Minimum& minimum : profile.minima) {
      if (minimum.objective < least.objective) least = minimum;
    }
  }
  return least;
}

}  // namespace

Solution solve(const Problem& problem, const std::vector<Run>& runs) {
  Misfit misfit(problem, runs, {}, true);
  Minimum best = least_minimum(misfit, {});
  misfit.inflate_near(best.point);
  best = least_minimum(misfit, {best.point});
  misfit.scale_model_errors(model_error_scale(misfit, best));
  if (misfit.model_scale() > 1) best = least_minimum(misfit, {best.point});
  PlausibleSets sets = plausible_sets(misfit, problem.settings.seed);
  std::vector<Profile> profiles = profiles_of(misfit, best, sets);
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    const Minimum least = least_of(profiles, best);
    if (least.objective > best.objective - kBetter) break;
    best = minimum_from(misfit, least.point);
    profiles = profiles_of(misfit, best, sets);
  }
  Misfit stated = misfit;
  stated.scale_model_errors(1);
  const Minimum least = misfit.model_scale() > 1 ? minimum_from(stated, best.point) : best;
  Freedom freedom = stated.freedom(least.point);
  return {.misfit = std::move(misfit),
          .best = std::move(best),
          .sets = std::move(sets),
          .profiles = std::move(profiles),
          .stated_chi2 = least.chi2,
          .stated_freedom = std::move(freedom)};
}

}  // namespace repose::calibrate
