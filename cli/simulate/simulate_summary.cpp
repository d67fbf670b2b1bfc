#include "cli/simulate/simulate_summary.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "base/units.h"
#include "calibrate/study/study_problem.h"
#include "dem/contact/adhesion.h"
#include "dem/experiment/experiment_table.h"

namespace repose::cli {

std::string source_of(const std::vector<calibrate::RunResult>& runs) {
  const auto pictured = std::count_if(
      runs.begin(), runs.end(),
      [](const calibrate::RunResult& run) { return calibrate::is_from_pictures(run); });
  if (pictured == 0) return "positions";
  return pictured == static_cast<std::ptrdiff_t>(runs.size()) ? "pictures" : "mixed";
}

std::optional<std::vector<double>> values_of(const std::vector<calibrate::RunResult>& runs) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const calibrate::RunResult& run : runs) {
    const auto value = calibrate::value_of(run);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::vector<double> readings_named(const std::vector<calibrate::RunResult>& runs,
                                   const std::string& name) {
  std::vector<double> readings;
  for (const calibrate::RunResult& run : runs) {
    if (const auto reading = run.readings.number(name)) readings.push_back(*reading);
  }
  return readings;
}

std::optional<calibrate::Summary> summarise(const std::vector<calibrate::RunResult>& runs) {
  const std::optional<std::vector<double>> values = values_of(runs);
  if (!values || values->empty()) return std::nullopt;
  calibrate::Summary repeats = calibrate::summarise(*values);
  if (std::equal(values->begin() + 1, values->end(), values->begin())) {
    repeats.sd.reset();
    repeats.mean_uncertainty.reset();
  }
  return repeats;
}

std::optional<HeapAngles> heap_angles(const std::vector<calibrate::RunResult>& runs) {
  if (runs.empty() || !values_of(runs)) return std::nullopt;
  HeapAngles angles;
  std::vector<double> positions, pictures, scatters;
  for (const calibrate::RunResult& run : runs) {
    if (run.views.empty()) return std::nullopt;
    if (const auto angle = calibrate::position_value(run)) positions.push_back(*angle);
    const calibrate::PictureMean seen = calibrate::picture_mean(run);
    angles.views += static_cast<int>(run.views.size());
    angles.refused += seen.refused;
    angles.flagged += seen.flagged;
    angles.pictured += calibrate::is_from_pictures(run) ? 1 : 0;
    if (seen.angle_deg) pictures.push_back(seen.angle_deg->mean);
    if (seen.angle_deg && seen.angle_deg->sd) scatters.push_back(*seen.angle_deg->sd);
  }
  const auto of_all = [&](const std::vector<double>& numbers) {
    return numbers.size() == runs.size() ? std::optional(calibrate::summarise(numbers))
                                         : std::nullopt;
  };
  const auto mean_of_all = [&](const std::vector<double>& numbers) {
    const auto summary = of_all(numbers);
    return summary ? std::optional(summary->mean) : std::nullopt;
  };
  angles.positions = of_all(positions);
  angles.pictures = of_all(pictures);
  // This reading uses the default definition.
  if (base::is_usual_definition(runs.front().definition)) {
    angles.between_views_positions = mean_of_all(readings_named(runs, "between_views_deg"));
  }
  angles.between_views_pictures = mean_of_all(scatters);
  return angles;
}

namespace {

RunWarning no_scatter(const SimulatePlan& plan, std::size_t repeats) {
  std::string message = fmt::format(
      "all {} repeats gave the same value: they show no scatter, so there is no interval.",
      repeats);
  if (!plan.experiment->is_stochastic) {
    message +=
        " This experiment is deterministic: its seed has no effect. Fix: use one repeat; on the "
        "bench "
        "it is the sliding friction that varies, so vary that: --set "
        "contact.particle_wall.sliding_friction=...";
  }
  return {"no_scatter", {}, message};
}

/// The fitted window has more effect than random scatter: than the interval of the mean, or, for a
/// single heap, than its scatter between directions.
std::optional<RunWarning> window_matters(const calibrate::Summary& summary,
                                         const std::vector<calibrate::RunResult>& runs) {
  double usual = 0, inner = 0;
  std::optional<double> between_views = 0;
  for (const calibrate::RunResult& run : runs) {
    const auto count = static_cast<double>(runs.size());
    const auto of_inner = run.readings.number("inner_window_deg");
    if (!run.value || !of_inner) return std::nullopt;  // nothing to compare
    usual += *run.value / count;
    inner += *of_inner / count;
    const auto scatter = run.readings.number("between_views_deg");
    between_views =
        between_views && scatter ? std::optional(*between_views + *scatter / count) : std::nullopt;
  }
  const std::optional<double> known =
      summary.mean_uncertainty ? summary.mean_uncertainty : between_views;
  if (!known || std::abs(usual - inner) <= *known) return std::nullopt;
  const double yardstick = *known;
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

/// Warns of repeats whose value is not the angle in their pictures.
void add_picture_warnings(const std::vector<calibrate::RunResult>& runs,
                          std::vector<RunWarning>& warnings) {
  if (!runs.empty() && !runs.front().picture_error.empty()) {
    warnings.push_back({"no_pictures",
                        {},
                        fmt::format("no pictures could be drawn: {}. The value is the angle from "
                                    "the grains' positions.",
                                    runs.front().picture_error)});
    return;
  }
  for (const calibrate::RunResult& run : runs) {
    if (run.views.empty() || calibrate::is_from_pictures(run)) continue;
    warnings.push_back({"pictures_refused", run.seed,
                        fmt::format("{} of {} pictures could not be measured: its value is the "
                                    "angle from the grains' positions.",
                                    calibrate::picture_mean(run).refused, run.views.size())});
  }
  const auto angles = heap_angles(runs);
  if (!angles || !angles->positions || source_of(runs) != "mixed") return;
  warnings.push_back(
      {"mixed_sources",
       {},
       fmt::format("the mean is of {} angles from pictures and {} from positions, which differ "
                   "because such low heaps are hard to see. Fix: leave the latter out, or compare "
                   "positions "
                   "with positions ({:.2f} degrees on average).",
                   angles->pictured, runs.size() - static_cast<std::size_t>(angles->pictured),
                   angles->positions->mean)});
}

/// Possible error of the bench's angle if its definition is not stated.
void add_definition_warning(const SimulatePlan& plan, const std::vector<calibrate::RunResult>& runs,
                            std::vector<RunWarning>& warnings) {
  const dem::StudyExperiment& described = plan.study.experiments.at(plan.experiment);
  if (!calibrate::is_definition_assumed(plan.spec.entry(), described)) return;
  std::string others;
  double used = 0;
  for (const auto& [name, mean] : calibrate::means_by_definition(runs)) {
    if (name == base::kUsualDefinition.name) {
      used = mean;
    } else {
      others += fmt::format("{}{} {:+.1f}", others.empty() ? "" : ", ", name, mean - used);
    }
  }
  warnings.push_back(
      {"assumed_definition",
       {},
       fmt::format("the study does not say by which definition the bench's angle was measured: {} "
                   "is assumed ({}). By others these heaps differ by, in degrees: {}. Fix: "
                   "definition = ... in [experiment.heap].",
                   base::kUsualDefinition.name, base::kUsualDefinition.description, others)});
}

/// Warns of heaps with fewer grains than requested, since no more fit into the tube.
void add_grain_warning(const SimulatePlan& plan, const calibrate::RunResult& run,
                       std::vector<RunWarning>& warnings) {
  const dem::ExperimentEntry& entry = plan.spec.entry();
  if (entry.grains_asked == nullptr) return;
  const std::optional<int> asked = entry.grains_asked(plan.spec.protocol);
  const auto grains = run.readings.number("grains");
  if (!asked || !grains || *grains >= *asked) return;
  warnings.push_back(
      {"fewer_grains", run.seed,
       fmt::format("only {1:g} of {0} grains fit into the tube. Fix: use fewer grains, "
                   "or a taller or wider tube.",
                   *asked, *grains)});
}

/// Warns of a roll that hopped, or stayed on the incline.
void add_roll_warning(const SimulatePlan& plan, const calibrate::RunResult& run,
                      std::vector<RunWarning>& warnings) {
  const std::string hops = calibrate::warning_of_hops(
      plan.spec.model.rolling, plan.spec.model.grain, run.readings.number("hop_mm").value_or(0));
  if (!hops.empty()) warnings.push_back({"hops", run.seed, hops});
  if (run.readings.number("stopped_on_incline").value_or(0) == 0 || !run.value) return;
  const double releases = run.readings.number("releases").value_or(1);
  warnings.push_back(
      {"stayed_on_incline", run.seed,
       fmt::format("the grain stayed on the incline in {:g} {}: it counts as 0, as on a bench's "
                   "sheet. Fix: a steeper incline, as on the bench; or less rolling friction, if "
                   "the bench's grains roll.",
                   releases, releases == 1 ? "release" : "releases")});
}

/// Other programs delete grains that leave their box, which is slightly larger than the plate.
void add_lost_warning(const SimulatePlan& plan, const calibrate::RunResult& run,
                      std::vector<RunWarning>& warnings) {
  const double off_plate = run.readings.number("grains_off_plate").value_or(0);
  if (plan.spec.simulator->title().empty() || off_plate == 0) return;
  warnings.push_back(
      {"grains_off_plate", run.seed,
       fmt::format("{:g} of {:g} grains left the plate and are not part of the heap; they were "
                   "deleted where they left the box. Fix: a larger plate, if the bench lost none.",
                   off_plate, run.readings.at("grains"))});
}

/// Warnings about the values of single repeats.
void add_run_warnings(const SimulatePlan& plan, const calibrate::RunResult& run,
                      std::vector<RunWarning>& warnings) {
  const std::uint64_t seed = run.seed;
  if (run.readings.number("at_rest") == 0) {
    warnings.push_back(
        {"not_at_rest", seed, "grains were still moving when the time limit was reached."});
  }
  const double never_rose = run.readings.number("never_rose").value_or(0);
  auto* const grains_per_run = plan.experiment->readings_per_run;
  if (grains_per_run != nullptr && never_rose > 0) {
    warnings.push_back(
        {"never_rose", seed,
         fmt::format("{:g} of {} grains did not rebound; they count as 0 in the mean.", never_rose,
                     grains_per_run(plan.spec.protocol))});
  }
  add_lost_warning(plan, run, warnings);
  add_grain_warning(plan, run, warnings);
  add_roll_warning(plan, run, warnings);
}

}  // namespace

std::vector<RunWarning> warnings_of(const SimulatePlan& plan,
                                    const std::vector<calibrate::RunResult>& runs) {
  std::vector<RunWarning> warnings;
  if (auto sticky = dem::adhesion_warning(plan.grain.shape.volume_m3,
                                          plan.study.model.grain_material.density_kg_m3)) {
    warnings.push_back({"cohesion", {}, *std::move(sticky) + '.'});
  }
  const auto summary = summarise(runs);
  if (summary && summary->n > 1 && !summary->sd) warnings.push_back(no_scatter(plan, runs.size()));
  if (summary && plan.spec.entry().is_pictured) {
    const bool is_default = base::is_usual_definition(plan.spec.definition);
    auto warning = is_default ? window_matters(*summary, runs) : std::nullopt;
    if (warning) warnings.push_back(*std::move(warning));
    add_picture_warnings(runs, warnings);
    add_definition_warning(plan, runs, warnings);
  }
  if (plan.spec.entry().systematic != nullptr) {
    const dem::SystematicFraction systematic = plan.spec.entry().systematic(plan.spec.protocol);
    if (!systematic.warning_name.empty()) {
      warnings.push_back(
          {std::string(systematic.warning_name), {}, std::string(systematic.warning)});
    }
  }
  for (const calibrate::RunResult& run : runs) {
    if (run.failure.empty()) add_run_warnings(plan, run, warnings);
  }
  return warnings;
}

}  // namespace repose::cli
