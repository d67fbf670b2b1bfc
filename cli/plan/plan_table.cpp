#include "cli/plan/plan_table.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "calibrate/start/usual_experiment.h"
#include "cli/common/table.h"
#include "dem/experiment/experiment_table.h"

namespace repose::cli {
namespace {

constexpr double kSeen = 1;  // uncertainties: less counts as no effect

/// "µs w" for contact.particle_wall.sliding_friction; "g" for grains, "tube" and so on.
std::string heading_of(const std::string& parameter) {
  const std::string_view which = parameter.ends_with("restitution")            ? "e"
                                 : parameter.ends_with("sliding_friction")     ? "µs"
                                 : parameter.ends_with("restitution_exponent") ? "α"
                                                                               : "µr";
  std::string other = "g";
  if (parameter.find("particle_wall") != std::string::npos) other = "w";
  for (const auto& [part, name] : dem::kWallParts) {
    if (parameter.find(fmt::format("particle_{}.", name)) != std::string::npos) other = name;
  }
  return fmt::format("{} {}", which, other);
}

/// A column for each parameter, after those given.
std::vector<Column> with_parameters(std::vector<Column> columns, const calibrate::Plan& plan) {
  for (const std::string& parameter : plan.parameters) {
    columns.push_back(number_column(heading_of(parameter)));
  }
  return columns;
}

std::string seconds_text(double seconds) {
  return seconds < 1 ? fmt::format("{:.2f} s", seconds) : fmt::format("{:.1f} s", seconds);
}

std::string effect_text(double effect) {
  if (effect < kSeen) return kMissing;
  return fmt::format("{:.{}f}", effect, effect < 9.95 ? 1 : 0);
}

std::string state_of(const calibrate::ForecastTerm& prospect) {
  std::string text = prospect.is_measured ? "measured" : "";
  if (prospect.failed_runs == 0) return text;
  if (!text.empty()) text += "; ";
  return text + fmt::format("no reading in {} of {} runs", prospect.failed_runs, prospect.runs);
}

Table effects_table(const calibrate::Plan& plan) {
  std::vector<Column> columns =
      with_parameters({{.heading = "experiment"}, number_column("a run")}, plan);
  columns.push_back({.heading = ""});
  Table table(columns);
  for (const calibrate::ForecastTerm& prospect : plan.prospects) {
    const auto run_s = plan.run_s.find(prospect.experiment);
    std::vector<std::string> row = {
        prospect.experiment, run_s == plan.run_s.end() ? kMissing : seconds_text(run_s->second)};
    for (const double effect : prospect.effects) row.push_back(effect_text(effect));
    row.push_back(state_of(prospect));
    table.add_row(row);
  }
  return table;
}

std::vector<std::string> outlook_row(const std::string& name,
                                     const calibrate::DesignForecast& outlook) {
  std::vector<std::string> row = {name};
  for (std::size_t k = 0; k < outlook.widths.size(); ++k) {
    const std::string width = fmt::format("{:.0f} %", 100 * outlook.widths[k]);
    const bool is_told = outlook.determined[k] >= calibrate::kEnough;
    row.push_back(is_told ? width : '(' + width + ')');
  }
  return row;
}

Table outlook_table(const calibrate::Plan& plan) {
  Table table(with_parameters({{.heading = "with"}}, plan));
  const bool any = std::ranges::any_of(plan.prospects, &calibrate::ForecastTerm::is_measured);
  table.add_row(outlook_row(any ? "what is measured" : "nothing measured", plan.now));
  for (const calibrate::PlannedStep& step : plan.steps) {
    table.add_row(outlook_row("+ " + plan.prospects[step.experiment].experiment, step.outlook));
  }
  return table;
}

/// Names of the parameters that remain undetermined in more than one material out of five.
std::vector<std::string> open_after(const calibrate::Plan& plan,
                                    const calibrate::DesignForecast& outlook) {
  std::vector<std::string> open;
  for (std::size_t k = 0; k < plan.parameters.size(); ++k) {
    if (outlook.determined[k] < calibrate::kEnough) open.push_back(heading_of(plan.parameters[k]));
  }
  return open;
}

std::string conclusion(const calibrate::Plan& plan) {
  const calibrate::DesignForecast& last = plan.steps.empty() ? plan.now : plan.steps.back().outlook;
  const std::vector<std::string> open = open_after(plan, last);
  const char* others = plan.steps.empty() ? "Further experiments" : "Others";
  if (open.empty()) {
    return fmt::format("{} would determine all of them. {} would add little.",
                       plan.steps.empty() ? "What is measured" : "These experiments", others);
  }
  return fmt::format(
      "{} would add little. {} would stay open in more than one material of five: it takes more "
      "readings, or a value from the literature.",
      others, fmt::join(open, ", "));
}

/// The study section needed to add the experiment.
void add_section(const dem::ExperimentEntry& entry, const calibrate::OfferedStudy& offered,
                 Page& page) {
  page.add_gap();
  const auto added = offered.added.find(&entry);
  if (added == offered.added.end()) {
    page.add(fmt::format("[experiment.{}] is in the study: measure it.", entry.name));
  } else {
    page.add_lines(calibrate::study_section(entry, added->second));
  }
}

}  // namespace

std::string plan_table(const calibrate::Plan& plan, const calibrate::OfferedStudy& offered,
                       int terminal_columns) {
  Page page(terminal_columns);
  page.add(fmt::format(
      "What each experiment tells: the change of its mean reading while a coefficient goes from "
      "bound to bound, over its uncertainty with {} readings.",
      plan.readings));
  page.add_gap();
  page.add(effects_table(plan));
  page.add_gap();
  page.add(
      "e restitution, α its exponent, µs sliding friction, µr rolling friction; w with the wall, g "
      "between grains; "
      "–: less than its uncertainty. a run: time of one simulation on a core of this machine.");
  page.add_gap();
  page.add(
      "Expected width of each 95 % interval, in percent of the distance of the bounds; in "
      "brackets: not determined in more than one plausible material of five.");
  page.add_gap();
  page.add(outlook_table(plan));
  page.add_gap();
  page.add(conclusion(plan));
  if (plan.steps.empty()) return page.text();
  page.add_gap();
  page.add("For the study file:");
  for (const calibrate::PlannedStep& step : plan.steps) {
    add_section(dem::experiment_named(plan.prospects[step.experiment].experiment), offered, page);
  }
  return page.text();
}

}  // namespace repose::cli
