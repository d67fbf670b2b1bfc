#include <cmath>

#include <fmt/format.h>

#include "calibrate/report/chapters.h"
#include "calibrate/report/figures.h"
#include "calibrate/report/wording.h"

namespace repose::calibrate::report {
namespace {

Chart rounds_chart(const StudyFolder& study) {
  Chart chart = plane_chart("rounds", "Coefficients round by round", {.name = "round", .unit = {}},
                            {.name = "place between the bounds, 0 … 1", .unit = {}});
  chart.y_range = {{-0.05, 1.05}};
  chart.has_whole_x = true;
  chart.caption =
      "Middle and standard deviation of what was plausible after each round of simulations. What "
      "the measurements tell settles and narrows.";
  for (const JsonView& parameter : study.result["parameters"].items()) {
    const std::string name = parameter["name"].text();
    const std::vector<double> bounds = parameter["bounds"].numbers();
    if (bounds.size() != 2 || !(bounds[1] > bounds[0])) continue;
    for (const JsonView& round : study.result["rounds"].items()) {
      const auto value = round["values"][name].number();
      if (!value) continue;
      const double fraction = (*value - bounds[0]) / (bounds[1] - bounds[0]);
      const double half = round["sd"][name].number().value_or(0) / (bounds[1] - bounds[0]);
      add_point(chart, label_of(name), Look::line, cell(round["round"].number()), fraction,
                fraction - half, fraction + half);
    }
  }
  return chart;
}

Table rounds_table(const StudyFolder& study) {
  Table table{.name = "round_work",
              .title = "Work",
              .data = {.columns = {{.name = "round", .unit = {}, .decimals = 0},
                                   {.name = "simulations", .unit = {}, .decimals = 0},
                                   {.name = "estimated work", .unit = "core s", .decimals = 0}},
                       .rows = {}}};
  for (const JsonView& round : study.result["rounds"].items()) {
    table.data.add({cell(round["round"].number()), cell(round["jobs"].number()),
                    cell(round["estimated_core_s"].number())});
  }
  return table;
}

Table surrogates_table(const StudyFolder& study) {
  Table table{.name = "surrogates",
              .title = "How well the fitted curves know the simulation",
              .data = {.columns = {{.name = "measured quantity", .unit = {}},
                                   {.name = "runs", .unit = {}, .decimals = 0},
                                   {.name = "failed", .unit = {}, .decimals = 0},
                                   {.name = "error of a run left out", .unit = {}},
                                   {.name = "the same in σ", .unit = {}, .decimals = 2},
                                   {.name = "σ widened by", .unit = {}, .decimals = 2}},
                       .rows = {}}};
  for (const JsonView& surrogate : study.result["surrogates"].items()) {
    table.data.add(
        {axis_of_observable(surrogate["observable"].text(), ""), cell(surrogate["runs"].number()),
         cell(surrogate["failed_runs"].number()), cell(surrogate["leave_one_out_error"].number()),
         cell(surrogate["leave_one_out_sigma"].number()), cell(surrogate["inflation"].number())});
  }
  return table;
}

}  // namespace

Chapter convergence_chapter(const StudyFolder& study) {
  Chapter chapter{.id = "convergence", .title = "How the fit went", .blocks = {}};
  if (!study.result["rounds"].items().empty()) {
    chapter.blocks.push_back(ChartRow{{rounds_chart(study)}});
    chapter.blocks.push_back(rounds_table(study));
  }
  if (!study.result["surrogates"].items().empty()) {
    chapter.blocks.push_back(surrogates_table(study));
    chapter.blocks.push_back(
        Paragraph{"Each run is predicted from all others; errors should be about 1 σ. Where they "
                  "are larger, σ was widened by that."});
  }
  return chapter;
}

}  // namespace repose::calibrate::report
