#include "calibrate/study/study_budget.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>

#include "base/input_error.h"
#include "calibrate/fit/points.h"

namespace repose::calibrate {

std::string name_of_minutes(double minutes) { return fmt::format("{:g}min", minutes); }

std::optional<double> minutes_in(const std::string& budget) {
  constexpr std::string_view kUnit = "min";
  if (!budget.ends_with(kUnit)) return std::nullopt;
  const std::string digits = budget.substr(0, budget.size() - kUnit.size());
  char* end = nullptr;
  const double minutes = std::strtod(digits.c_str(), &end);
  if (digits.empty() || *end != '\0' || !(minutes > 0)) return std::nullopt;
  return minutes;
}

namespace {

constexpr double kMinute_s = 60;
Budget plain_budget(const std::string& name) {
  if (name == "quick") {
    return {.name = name,
            .description = "14 minutes of one core for the fit",
            .settings = {.budget_s = 14 * kMinute_s, .max_jobs = 400, .max_rounds = 4},
            .round_repeats = 6,
            .verification_repeats = 24,
            .family_sets = 2};
  }
  if (name == "standard") {
    return {.name = name,
            .description = "125 minutes of one core for the fit",
            .settings = {.budget_s = 125 * kMinute_s, .max_jobs = 2000, .max_rounds = 6},
            .round_repeats = 6,
            .verification_repeats = 24,
            .family_sets = 3};
  }
  if (name == "paper") {
    return {.name = name,
            .description = "62 simulations at most for the fit, as many as the publication made",
            .settings = {.budget_s = 60 * kMinute_s, .max_jobs = 62, .max_rounds = 3},
            .round_repeats = 6,
            .verification_repeats = 24,
            .family_sets = 0};
  }
  throw base::InputError({.subject = "budget",
                          .value = fmt::format("= {}:", name),
                          .rule = "must be quick, standard or paper",
                          .fix = "choose quick."});
}

}  // namespace

Budget budget_named(const std::string& name) {
  Budget budget = plain_budget(name);
  budget.longest_run_s = budget.settings.budget_s;
  return budget;
}

Budget budget_of(double minutes, int cores, double pace) {
  constexpr double kLong_minutes = 60, kOfTheWork = 1. / 12, kOfTheTime = 1. / 6;
  Budget budget = plain_budget(minutes < kLong_minutes ? "quick" : "standard");
  budget.name = name_of_minutes(minutes);
  budget.minutes = minutes;
  // Checks follow one another, and each run has one core.
  budget.longest_run_s = std::min(kOfTheWork * cores, kOfTheTime) * kMinute_s * minutes / pace;
  return budget;
}

Budget with_affordable_checks(Budget budget, const Problem& problem) {
  constexpr double kChecks = .5;  // fraction of the seconds of the fit
  constexpr int kFewest = 4, kFewestOfRound = 2, kFew = 12, kFewRounds = 2;
  double dearest_s = 0;
  for (const Experiment& experiment : measured_experiments(problem)) {
    if (experiment.coarse || experiment.full.size != 1)
      dearest_s = std::max(dearest_s, experiment.run_s);
  }
  if (dearest_s == 0 || budget.minutes) return budget;
  const double affordable = kChecks * problem.settings.budget_s / dearest_s;
  if (affordable >= budget.verification_repeats) return budget;
  budget.verification_repeats = std::max(kFewest, static_cast<int>(affordable));
  budget.round_repeats = std::clamp(budget.verification_repeats / 2, kFewestOfRound,
                                    std::max(budget.round_repeats, kFewestOfRound));
  if (budget.verification_repeats < kFew) {
    budget.check_rounds = kFewRounds;
    budget.family_sets = 0;
  }
  return budget;
}

}  // namespace repose::calibrate
