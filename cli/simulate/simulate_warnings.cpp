#include "cli/simulate/simulate_warnings.h"

#include <cmath>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/units.h"
#include "cli/simulate/simulate_values.h"

namespace repose::cli {
namespace {

double reading_of(const Run& run, const std::string& name, double otherwise) {
  const auto found = run.result.readings.find(name);
  return found == run.result.readings.end() ? otherwise : found->second;
}

RunWarning no_scatter(const SimulatePlan& plan, std::size_t repeats) {
  std::string message = fmt::format(
      "all {} repeats gave the same value: they show no scatter, so there is no interval.",
      repeats);
  if (!dem::entry_of(plan.experiment).is_stochastic) {
    message +=
        " This experiment is deterministic: its seed has no effect. Fix: use one repeat; on the "
        "bench "
        "it is the sliding friction that varies, so vary that: --set "
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
    usual += run.result.value / count;
    inner += reading_of(run, "inner_window_deg", run.result.value) / count;
    between_views += reading_of(run, "between_views_deg", 0) / count;
  }
  const double yardstick = summary.mean_uncertainty.value_or(between_views);
  if (std::abs(usual - inner) <= yardstick) return std::nullopt;
  return RunWarning{
      "window",
      {},
      fmt::format(
          "the angle depends on the window: {:.2f} degrees between 20 and 80 % of the "
          "height, {:.2f} between 30 and 70 %, which differ by more than {} ({:.2f}). "
          "Measure pictures with the same window, and state it.",
          usual, inner,
          summary.mean_uncertainty ? "the half-width of the interval" : "the scatter between views",
          yardstick)};
}

/// Repeats whose value is not the angle in their pictures.
void add_picture_warnings(const std::vector<Run>& runs, std::vector<RunWarning>& warnings) {
  if (!runs.empty() && !runs.front().result.picture_error.empty()) {
    warnings.push_back({"no_pictures",
                        {},
                        fmt::format("no pictures could be drawn: {}. The value is the angle from "
                                    "the grains' positions.",
                                    runs.front().result.picture_error)});
    return;
  }
  for (const Run& run : runs) {
    const calibrate::SimulatedRun& result = run.result;
    if (result.views.empty() || calibrate::is_from_pictures(result)) continue;
    warnings.push_back(
        {"pictures_refused", result.seed,
         fmt::format("{} of {} pictures could not be measured: its value is the "
                     "angle from the grains' positions.",
                     calibrate::mean_of_views(result.views).refused, result.views.size())});
  }
  const auto angles = heap_angles(runs);
  if (!angles || source_of(runs) != "mixed") return;
  warnings.push_back(
      {"mixed_sources",
       {},
       fmt::format("the mean is of {} angles from pictures and {} from positions, which differ "
                   "because such low heaps are hard to see. Fix: leave the latter out, or compare "
                   "positions "
                   "with positions ({:.2f} degrees on average).",
                   angles->pictured, runs.size() - static_cast<std::size_t>(angles->pictured),
                   angles->positions.mean)});
}

/// Heaps of fewer grains than the study asks for, since no more fit into the tube.
void add_grain_warning(const SimulatePlan& plan, const Run& run,
                       std::vector<RunWarning>& warnings) {
  const auto* heap = std::get_if<dem::HeapProtocol>(&plan.spec.protocol);
  if (heap == nullptr || !heap->grains) return;
  const double grains = reading_of(run, "grains", *heap->grains);
  if (grains >= *heap->grains) return;
  warnings.push_back(
      {"fewer_grains", run.result.seed,
       fmt::format("only {1:g} of {0} grains fit into the tube. Fix: use fewer grains, "
                   "or a taller or wider tube.",
                   *heap->grains, grains)});
}

/// A roll that hopped, or whose value is no distance along the flat.
void add_roll_warning(const SimulatePlan& plan, const Run& run, std::vector<RunWarning>& warnings) {
  const auto* roll = std::get_if<dem::RollProtocol>(&plan.spec.protocol);
  if (roll == nullptr) return;
  const std::string hops = calibrate::warning_of_hops(
      plan.spec.model.rolling, plan.spec.model.grain, reading_of(run, "hop_mm", 0));
  if (!hops.empty()) warnings.push_back({"hops", run.result.seed, hops});
  if (reading_of(run, "stopped_on_incline", 0) == 0) return;
  const double releases = reading_of(run, "releases", 1);
  warnings.push_back(
      {"stayed_on_incline", run.result.seed,
       fmt::format(
           "the grain did not reach the flat in {:g} {}: its value is less its distance up "
           "the incline from the foot, {:.3f} mm from where it was let go. Fix: a steeper "
           "incline, as on the bench; or less rolling friction, if the bench's grains roll.",
           releases, releases == 1 ? "release" : "releases",
           kMmPerM * roll->release_m + run.result.value)});
}

/// What single repeats tell against their values.
void add_run_warnings(const SimulatePlan& plan, const Run& run, std::vector<RunWarning>& warnings) {
  const std::uint64_t seed = run.result.seed;
  if (reading_of(run, "no_heap", 0) != 0) {
    warnings.push_back({"no_heap", seed,
                        "the grains spread out in a layer; its angle is not an angle of repose."});
  }
  if (reading_of(run, "at_rest", 1) == 0) {
    warnings.push_back(
        {"not_at_rest", seed, "grains were still moving when the time limit was reached."});
  }
  const double never_rose = reading_of(run, "never_rose", 0);
  auto* const grains_per_run = dem::entry_of(plan.experiment).readings_per_run;
  if (grains_per_run != nullptr && never_rose > 0) {
    warnings.push_back(
        {"never_rose", seed,
         fmt::format("{:g} of {} grains did not rebound; they count as 0 in the mean.", never_rose,
                     grains_per_run(plan.spec.protocol))});
  }
  add_grain_warning(plan, run, warnings);
  add_roll_warning(plan, run, warnings);
}

}  // namespace

std::vector<RunWarning> warnings_of(const SimulatePlan& plan, const std::vector<Run>& runs) {
  std::vector<RunWarning> warnings;
  const auto summary = summarise(runs);
  if (summary && summary->n > 1 && !summary->sd) warnings.push_back(no_scatter(plan, runs.size()));
  if (summary && plan.spec.entry().is_pictured) {
    if (auto warning = window_matters(*summary, runs)) warnings.push_back(*std::move(warning));
    add_picture_warnings(runs, warnings);
  }
  for (const Run& run : runs) add_run_warnings(plan, run, warnings);
  return warnings;
}

}  // namespace repose::cli
