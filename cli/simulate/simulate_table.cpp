#include "cli/simulate/simulate_table.h"

#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "cli/common/terminal.h"
#include "cli/simulate/simulate_json.h"
#include "cli/simulate/simulate_values.h"
#include "dem/contact/rolling_name.h"

namespace repose::cli {
namespace {

std::string unit_sign(const SimulatePlan& plan) {
  const std::string_view unit = dem::entry_of(plan.experiment).unit;
  return unit == "deg" ? "°" : fmt::format(" {}", unit);
}

std::string repeats_text(const SimulatePlan& plan, const std::vector<Run>& runs) {
  constexpr double kMicroseconds = 1e6, kMillion = 1e6;
  const dem::ExperimentEntry& entry = dem::entry_of(plan.experiment);
  const bool is_mixed = source_of(runs) == "mixed";
  std::size_t width = 4;
  for (const Run& run : runs) width = std::max(width, std::to_string(run.result.seed).size());
  std::string text = fmt::format("{}: {}\n", entry.name, entry.value_name);
  text += fmt::format("{:>{}}{:>14}{:>12}{:>10}{:>10}{:>12}\n", "seed", width,
                      fmt::format("value [{}]", entry.unit), "steps", "step [us]", "time [s]",
                      "Mclump-st/s");
  for (const Run& run : runs) {
    const calibrate::SimulatedRun& result = run.result;
    text +=
        fmt::format("{:>{}}{:>14.3f}{:>12}{:>10.3f}{:>10.1f}{:>12.3f}", result.seed, width,
                    calibrate::value_of(result), result.steps, result.timestep_s * kMicroseconds,
                    result.wall_s, result.clump_steps / result.wall_s / kMillion);
    if (is_mixed && !calibrate::is_from_pictures(result)) text += "  from positions";
    text += '\n';
  }
  return text;
}

std::string mean_text(const SimulatePlan& plan, const std::vector<Run>& runs) {
  const auto summary = summarise(runs);
  const std::string unit = unit_sign(plan);
  if (!summary) return "no mean: a repeat gave no number\n";
  if (!summary->sd && summary->n > 1) {
    return fmt::format("mean {:.3f}{} n = {}, all the same: no scatter and no interval\n",
                       summary->mean, unit, summary->n);
  }
  if (!summary->sd || !summary->mean_uncertainty) {
    return fmt::format("mean {:.3f}{} n = 1, which has no scatter and no interval: --repeats 5\n",
                       summary->mean, unit);
  }
  return fmt::format(
      "mean {:.3f}{} sd {:.3f}{} n = {}, 95 % interval of the mean {:.3f} … {:.3f}{}"
      " (Student)\n",
      summary->mean, unit, *summary->sd, unit, summary->n,
      summary->mean - *summary->mean_uncertainty, summary->mean + *summary->mean_uncertainty, unit);
}

std::string number_or_dash(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f}", *value) : "–";
}

/// A heap's angle from its pictures and from where its grains lie.
std::string sources_text(const std::vector<Run>& runs) {
  const auto angles = heap_angles(runs);
  if (!angles) return {};
  const auto row = [](const char* source, const std::optional<calibrate::Summary>& repeats,
                      const std::optional<double>& between_views, const std::string& use) {
    const auto mean = repeats ? std::optional(repeats->mean) : std::nullopt;
    const auto sd = repeats ? repeats->sd : std::nullopt;
    return fmt::format("  {}{:>9}{:>15}{:>15}{}\n", padded(source, 14), number_or_dash(mean),
                       number_or_dash(sd), number_or_dash(between_views), use);
  };
  const auto used = [&](int count) {
    if (count == 0) return std::string();
    if (count == static_cast<int>(runs.size())) return std::string("   the value");
    return fmt::format("   the value of {}", count);
  };
  return fmt::format("\n  {}{:>9}{:>15}{:>15}\n", padded("angle [deg]", 14), "mean",
                     "sd of repeats", "sd of views") +
         row("pictures", angles->pictures, angles->between_views_pictures, used(angles->pictured)) +
         row("positions", angles->positions, angles->between_views_positions,
             used(static_cast<int>(runs.size()) - angles->pictured)) +
         fmt::format("  {} {}: {} refused, {} flagged\n", angles->views,
                     angles->views == 1 ? "picture" : "pictures", angles->refused, angles->flagged);
}

/// "measured 9.420 mm, n = 10; simulated - measured = -0.290 mm (-3.1 %)"
std::string measured_text(const SimulatePlan& plan, const std::vector<Run>& runs) {
  const dem::Measured& measured = dem::measured_in(plan.study, plan.experiment);
  if (!measured.pictures.empty()) {
    return "measured in pictures: repose measure gives their angle\n";
  }
  std::optional<double> mean = measured.mean, sd = measured.sd;
  std::optional<int> n = measured.count;
  if (!measured.values.empty()) {
    const calibrate::Summary repeats = calibrate::summarise(measured.values);
    mean = repeats.mean;
    sd = repeats.sd;
    n = repeats.n;
  }
  if (!mean) return {};
  const std::string unit = unit_sign(plan);
  std::string text = fmt::format("measured {:.3f}{}", *mean, unit);
  if (sd) text += fmt::format(" sd {:.3f}{}", *sd, unit);
  if (n) text += fmt::format(" n = {}", *n);
  if (const auto summary = summarise(runs)) {
    const double difference = summary->mean - *mean;
    text += fmt::format("; simulated is {:+.3f}{} off", difference, unit);
    if (*mean != 0) text += fmt::format(" ({:+.1f} %)", 100 * difference / *mean);
  }
  return text + '\n';
}

/// The mean of each other reading over the repeats.
std::string readings_text(const std::vector<Run>& runs) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  struct Spread {
    double sum = 0, least = kInfinity, greatest = -kInfinity;
    int count = 0;
  };
  std::map<std::string, Spread> spreads;
  std::size_t width = 0;
  for (const Run& run : runs) {
    for (const auto& [name, value] : run.result.readings) {
      Spread& spread = spreads[name];
      spread.sum += value;
      spread.least = std::min(spread.least, value);
      spread.greatest = std::max(spread.greatest, value);
      ++spread.count;
      width = std::max(width, name.size());
    }
  }
  std::string text = spreads.empty() ? "" : "\nother readings\n";
  for (const auto& [name, spread] : spreads) {
    text += fmt::format("  {}  {:.4g}", padded(name, width), spread.sum / spread.count);
    if (spread.count > 1) text += fmt::format("  ({:.4g} … {:.4g})", spread.least, spread.greatest);
    text += '\n';
  }
  return text;
}

std::string coefficients_text(const dem::PairCoefficients& pair) {
  return fmt::format("restitution {:g}, sliding friction {:g}, rolling friction {:g}",
                     pair.restitution, pair.sliding_friction, pair.rolling_friction);
}

/// Coefficients mean nothing without these.
std::string belongs_to_text(const SimulatePlan& plan, std::size_t width) {
  const dem::Model& model = plan.spec.model;
  const std::string step =
      model.timestep_s ? fmt::format("{:g} s, as asked for", *model.timestep_s)
                       : fmt::format("{:g} of the longest accurate one", model.timestep_fraction);
  std::vector<std::pair<std::string, std::string>> facts = {
      {"contact model", std::string(dem::kContactModel)},
      {"rolling model",
       fmt::format("{}: {}", dem::name_of(model.rolling), dem::rolling_definition(model.rolling))},
      {"clump", fmt::format("{} spheres, volume error {:.1f} % ({})", model.grain.spheres.size(),
                            100 * plan.grain.errors.volume_error, plan.grain.source)},
      {"stiffness factor", fmt::format("{:g}", model.stiffness_factor)},
      {"time step", step},
      {"with the wall", coefficients_text(model.grain_wall)}};
  if (dem::has_grain_contacts(plan.experiment)) {
    facts.emplace_back("between grains", coefficients_text(model.grain_grain));
  }
  constexpr std::size_t kNames = 20;
  std::string text = "these values belong to\n";
  for (const auto& [name, fact] : facts) {
    std::string before = padded("  " + name, kNames);
    for (const std::string& line : wrapped(fact, width - kNames)) {
      text += before + line + '\n';
      before = std::string(kNames, ' ');
    }
  }
  return text;
}

}  // namespace

std::string simulate_table(const SimulatePlan& plan, const std::vector<Run>& runs, int columns) {
  constexpr int kNarrowest = 40;
  std::string text = repeats_text(plan, runs) + '\n';
  const auto width = static_cast<std::size_t>(std::max(kNarrowest, columns));
  for (const std::string& line : {mean_text(plan, runs), measured_text(plan, runs)}) {
    for (const std::string& part : wrapped(line, width)) text += part + '\n';
  }
  text += sources_text(runs);
  text += readings_text(runs) + '\n';
  return text + belongs_to_text(plan, width);
}

}  // namespace repose::cli
