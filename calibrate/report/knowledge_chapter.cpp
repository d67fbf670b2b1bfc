#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "calibrate/fit/profile.h"
#include "calibrate/report/chapters.h"
#include "calibrate/report/figures.h"
#include "calibrate/report/wording.h"

namespace repose::calibrate::report {
namespace {

Chart profile_chart(const JsonView& parameter) {
  const std::string label = label_of(parameter["name"].text());
  Chart chart = plane_chart("profile_" + parameter["name"].text(), titled(label),
                            {.name = label, .unit = {}}, {.name = "χ² above the best", .unit = {}});
  std::vector<double> span = parameter["bounds"].numbers();
  std::vector<std::array<double, 2>> points;
  for (const JsonView& point : parameter["profile"].items()) {
    const std::vector<double> pair = point.numbers();
    if (pair.size() == 2 && std::isfinite(pair[0] + pair[1])) points.push_back({pair[0], pair[1]});
  }
  std::sort(points.begin(), points.end());
  if (points.empty()) return chart;
  for (const auto& [value, chi2] : points) {
    add_point(chart, "others fitted again", Look::points, value, chi2);
  }
  add_level(chart, "95 % limit", Look::limit, {points.front()[0], points.back()[0]}, kChi2Limit,
            kChi2Limit, kChi2Limit);
  const std::vector<double> interval = parameter["interval"].numbers();
  if (interval.size() == 2) {
    add_point(chart, "best fit", Look::best, cell(parameter["value"].number()), 0.0,
              cell(interval[0]), cell(interval[1]));
  }
  constexpr double kShown = 12;
  chart.y_range = {{-0.8, kShown}};
  const std::string verdict = parameter["verdict"].text();
  chart.caption = verdict == "determined" ? "It rises above the limit on both sides: determined."
                  : verdict == "one-sided"
                      ? "It rises above the limit on one side only: one-sided."
                      : "It stays below the limit nearly everywhere: these data do not tell it.";
  return chart;
}

double fraction_of(double value, const std::vector<double>& bounds) {
  return bounds.size() == 2 && bounds[1] > bounds[0] ? (value - bounds[0]) / (bounds[1] - bounds[0])
                                                     : std::nan("");
}

Chart family_chart(const StudyFolder& study) {
  Chart chart = plane_chart("equivalence_family", "Sets that fit as well",
                            {.name = "coefficient", .unit = {}},
                            {.name = "place between the bounds, 0 … 1", .unit = {}});
  chart.x_title = "";
  chart.y_range = {{-0.05, 1.05}};
  chart.caption =
      "Each line is one set of coefficients whose misfit is within the 95 % limit. Where the lines "
      "meet, the measurements tell the coefficient; where they spread, they do not.";
  const auto parameters = study.result["parameters"].items();
  const auto add = [&](const std::string& series, const auto& value_of) {
    for (const JsonView& parameter : parameters) {
      const auto value = value_of(parameter);
      if (!value) continue;
      add_point(chart, series, Look::line, label_of(parameter["name"].text()),
                cell(fraction_of(*value, parameter["bounds"].numbers())));
    }
  };
  add("best fit", [](const JsonView& parameter) { return parameter["value"].number(); });
  int number = 0;
  for (const JsonView& set : study.result["equivalence_family"].items()) {
    add(fmt::format("set {}", ++number), [&](const JsonView& parameter) {
      return set["parameters"][parameter["name"].text()].number();
    });
  }
  return chart;
}

Table family_table(const StudyFolder& study) {
  Table table{.name = "equivalence_sets", .title = "Sets that fit as well", .data = {}};
  table.data.columns = {{.name = "set", .unit = {}}};
  const auto parameters = study.result["parameters"].items();
  for (const JsonView& parameter : parameters) {
    table.data.columns.push_back({.name = label_of(parameter["name"].text()), .unit = {}});
  }
  table.data.columns.push_back({.name = "χ² above the best", .unit = {}, .decimals = 2});
  table.data.columns.push_back({.name = "simulated", .unit = {}});
  int number = 0;
  for (const JsonView& set : study.result["equivalence_family"].items()) {
    std::vector<Cell> row = {fmt::format("{}", ++number)};
    for (const JsonView& parameter : parameters) {
      row.push_back(cell(set["parameters"][parameter["name"].text()].number()));
    }
    row.push_back(cell(set["chi2_above_best"].number()));
    row.emplace_back(std::string(!set["verified"].exists()   ? "not checked"
                                 : set["verified"].is_true() ? "agrees"
                                                             : "does not agree"));
    table.data.add(std::move(row));
  }
  return table;
}

Table correlation_table(const StudyFolder& study) {
  Table table{.name = "correlation",
              .title = "Correlation of what is not known (±1: only a combination is known)",
              .data = {}};
  table.data.columns = {{.name = "coefficient", .unit = {}}};
  const auto parameters = study.result["parameters"].items();
  const auto rows = study.result["correlation"].items();
  for (const JsonView& parameter : parameters) {
    table.data.columns.push_back(
        {.name = label_of(parameter["name"].text()), .unit = {}, .decimals = 2});
  }
  for (std::size_t k = 0; k < parameters.size() && k < rows.size(); ++k) {
    std::vector<Cell> row = {label_of(parameters[k]["name"].text())};
    for (const double value : rows[k].numbers()) row.push_back(cell(value));
    row.resize(table.data.columns.size());
    table.data.add(std::move(row));
  }
  return table;
}

}  // namespace

Chapter knowledge_chapter(const StudyFolder& study) {
  Chapter chapter{.id = "knowledge", .title = "How well it is known", .blocks = {}};
  ChartRow profiles;
  for (const JsonView& parameter : study.result["parameters"].items()) {
    Chart chart = profile_chart(parameter);
    if (!chart.data.rows.empty()) profiles.charts.push_back(std::move(chart));
  }
  if (!profiles.charts.empty()) {
    chapter.blocks.push_back(Heading{"Profile likelihoods"});
    chapter.blocks.push_back(Paragraph{fmt::format(
        "Each coefficient is held at one value after the other while all others are fitted again. "
        "Values whose misfit χ² rises by less than {:.2f} form the 95 % interval.",
        kChi2Limit)});
    chapter.blocks.push_back(std::move(profiles));
  }
  if (!study.result["equivalence_family"].items().empty()) {
    chapter.blocks.push_back(Heading{"Equivalence family"});
    chapter.blocks.push_back(ChartRow{{family_chart(study)}});
    chapter.blocks.push_back(family_table(study));
  }
  if (!study.result["correlation"].items().empty()) {
    chapter.blocks.push_back(Heading{"Correlations"});
    chapter.blocks.push_back(correlation_table(study));
  }
  return chapter;
}

}  // namespace repose::calibrate::report
