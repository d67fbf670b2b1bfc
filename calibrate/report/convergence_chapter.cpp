#include "calibrate/report/chapters.h"
#include "calibrate/report/figures.h"
#include "calibrate/report/wording.h"

namespace repose::calibrate::report {
namespace {

Chart rounds_chart(const JointResult& joint) {
  Chart chart = plane_chart("rounds", "Coefficients round by round", {.name = "round", .unit = {}},
                            {.name = "position between the bounds, 0 … 1", .unit = {}});
  chart.y_range = {{-0.05, 1.05}};
  chart.has_whole_x = true;
  chart.caption =
      "Mean and standard deviation of the plausible coefficients after each round of simulations. "
      "Coefficients that the measurements determine settle, and their bars shrink.";
  for (std::size_t k = 0; k < joint.parameters.size(); ++k) {
    const ResultParameter& parameter = joint.parameters[k];
    const double span = parameter.bounds.high - parameter.bounds.low;
    for (const RoundSummary& round : joint.rounds) {
      const double fraction = (round.values[k] - parameter.bounds.low) / span;
      const double half = round.sd[k] / span;
      add_point(chart, label_of(parameter.name), Look::line, static_cast<double>(round.round),
                cell(fraction), cell(fraction - half), cell(fraction + half));
    }
  }
  return chart;
}

Table rounds_table(const JointResult& joint) {
  Table table{.name = "round_work",
              .title = "Work",
              .data = {.columns = {{.name = "round", .unit = {}, .decimals = 0},
                                   {.name = "simulations", .unit = {}, .decimals = 0},
                                   {.name = "estimated work", .unit = "core s", .decimals = 0}},
                       .rows = {}}};
  for (const RoundSummary& round : joint.rounds) {
    table.data.add(
        {static_cast<double>(round.round), static_cast<double>(round.jobs), cell(round.seconds)});
  }
  return table;
}

Table surrogates_table(const JointResult& joint) {
  Table table{.name = "surrogates",
              .title = "How well the fitted curves predict the simulation",
              .data = {.columns = {{.name = "measured quantity", .unit = {}},
                                   {.name = "runs", .unit = {}, .decimals = 0},
                                   {.name = "failed", .unit = {}, .decimals = 0},
                                   {.name = "leave-one-out error", .unit = {}},
                                   {.name = "in σ", .unit = {}, .decimals = 2},
                                   {.name = "σ widened by", .unit = {}, .decimals = 2}},
                       .rows = {}}};
  for (const SurrogateQuality& surrogate : joint.surrogates) {
    table.data.add({axis_of_observable(surrogate.observable, ""),
                    static_cast<double>(surrogate.runs), static_cast<double>(surrogate.failed_runs),
                    cell(surrogate.leave_one_out_error), cell(surrogate.leave_one_out_sigma),
                    cell(surrogate.inflation)});
  }
  return table;
}

}  // namespace

Chapter convergence_chapter(const JointResult& joint) {
  Chapter chapter{.id = "convergence", .title = "Progress of the fit", .blocks = {}};
  if (!joint.rounds.empty()) {
    chapter.blocks.push_back(ChartRow{{rounds_chart(joint)}});
    chapter.blocks.push_back(rounds_table(joint));
  }
  if (!joint.surrogates.empty()) {
    chapter.blocks.push_back(surrogates_table(joint));
    chapter.blocks.push_back(
        Paragraph{"Each run is predicted from all others; errors should be about 1 σ. Where they "
                  "are larger, σ was increased by that factor."});
  }
  return chapter;
}

}  // namespace repose::calibrate::report
