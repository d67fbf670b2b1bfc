#include "cli/simulate/simulate_warnings.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "cli/simulate/simulate_values.h"

namespace repose::cli {
namespace {

double reading_of(const Run& run, const std::string& name, double otherwise) {
  const auto found = run.repeat.readings.find(name);
  return found == run.repeat.readings.end() ? otherwise : found->second;
}

RunWarning no_scatter(const SimulatePlan& plan, std::size_t repeats) {
  std::string message = fmt::format(
      "all {} repeats gave the same value: they tell nothing about scatter, and there is no "
      "interval.",
      repeats);
  if (plan.experiment == dem::Experiment::tilt) {
    message +=
        " Nothing in this experiment is left to chance: its seed has no effect. Fix: one repeat; "
        "what scatters on the bench is the sliding friction, so vary that: --set "
        "contact.particle_wall.sliding_friction=...";
  }
  return {"no_scatter", {}, message};
}

/// The stretch that is fitted matters more than chance does: than the interval of the mean, or for
/// a single heap, which has none, than its scatter between directions.
std::optional<RunWarning> window_matters(const calibrate::Summary& summary,
                                         const std::vector<Run>& runs) {
  double usual = 0, inner = 0, between_views = 0;
  for (const Run& run : runs) {
    if (reading_of(run, "no_heap", 0) != 0) return std::nullopt;  // a warning that says more
    const auto count = static_cast<double>(runs.size());
    usual += run.repeat.value / count;
    inner += reading_of(run, "inner_window_deg", run.repeat.value) / count;
    between_views += reading_of(run, "between_views_deg", 0) / count;
  }
  const double yardstick = summary.mean_uncertainty.value_or(between_views);
  if (std::abs(usual - inner) <= yardstick) return std::nullopt;
  return RunWarning{
      "window",
      {},
      fmt::format("the angle depends on the stretch that is fitted: {:.2f} degrees between 20 and "
                  "80 % of the height, {:.2f} between 30 and 70 %, more apart than {} ({:.2f}). "
                  "Measure pictures in the same stretch, and name it.",
                  usual, inner,
                  summary.mean_uncertainty ? "the half-width of the interval"
                                           : "directions of view scatter",
                  yardstick)};
}

/// What keeps the pictures from being the value, or should be looked at in them.
std::optional<RunWarning> pictures_tell(const std::vector<Run>& runs) {
  if (runs.empty() || !runs.front().pictures) return std::nullopt;
  const std::string& error = runs.front().pictures->error;
  if (!error.empty()) {
    return RunWarning{"no_pictures",
                      {},
                      fmt::format("no pictures could be drawn: {}. The value is the angle from the "
                                  "grains' positions.",
                                  error)};
  }
  if (is_from_pictures(runs)) return std::nullopt;
  std::size_t most = 0, views = 0;
  std::uint64_t seed = 0;
  for (const Run& run : runs) {
    const auto refused =
        static_cast<std::size_t>(count(run.pictures->views, vision::MeasureStatus::refused));
    if (refused < most) continue;
    most = refused;
    views = run.pictures->views.size();
    seed = run.repeat.seed;
  }
  return RunWarning{"pictures_refused",
                    {},
                    fmt::format("{} of {} pictures of seed {} could not be measured: the value is "
                                "the angle from the grains' positions.",
                                most, views, seed)};
}

}  // namespace

std::vector<RunWarning> warnings_of(const SimulatePlan& plan, const std::vector<Run>& runs) {
  std::vector<RunWarning> warnings;
  const auto summary = summarise(runs);
  if (summary && summary->n > 1 && !summary->sd) warnings.push_back(no_scatter(plan, runs.size()));
  if (summary && plan.experiment == dem::Experiment::heap) {
    if (auto warning = window_matters(*summary, runs)) warnings.push_back(*std::move(warning));
    if (auto warning = pictures_tell(runs)) warnings.push_back(*std::move(warning));
  }
  for (const Run& run : runs) {
    const std::uint64_t seed = run.repeat.seed;
    if (plan.experiment == dem::Experiment::heap) {
      if (reading_of(run, "no_heap", 0) != 0) {
        warnings.push_back(
            {"no_heap", seed, "the grains spread in a layer; its angle is no angle of repose."});
      }
      if (reading_of(run, "at_rest", 1) == 0) {
        warnings.push_back({"not_at_rest", seed, "grains were still moving when the time was up."});
      }
    }
    const double never_rose = reading_of(run, "never_rose", 0);
    if (plan.experiment == dem::Experiment::drop && never_rose > 0) {
      warnings.push_back(
          {"never_rose", seed,
           fmt::format("{:g} of {} grains did not rise again; they count as 0 in the mean.",
                       never_rose, plan.study.drop->grains)});
    }
  }
  return warnings;
}

}  // namespace repose::cli
