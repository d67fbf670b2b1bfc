#include <fmt/format.h>

#include "calibrate/report/chapters.h"
#include "calibrate/report/document.h"
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
    const int failed =
        surrogate.failed_runs + (surrogate.coarse ? surrogate.coarse->failed_runs : 0);
    table.data.add({axis_of_observable(surrogate.observable, ""),
                    static_cast<double>(surrogate.runs), static_cast<double>(failed),
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

namespace {

void add_variance(DataTable& data, const std::string& source,
                  const std::optional<Variance>& variance) {
  if (!variance) return;
  std::optional<double> mean_square;
  if (variance->df > 0) mean_square = variance->mean_square();
  data.add({source, cell(variance->sum_of_squares), static_cast<double>(variance->df),
            cell(mean_square), cell(variance->f), cell(variance->p)});
}

Table anova_table(const SurfaceSummary& regression, const std::string& of) {
  Table table{.name = file_stem("anova_" + of),
              .title = "Analysis of variance",
              .data = {.columns = {{.name = "source", .unit = {}},
                                   {.name = "sum of squares", .unit = {}},
                                   {.name = "df", .unit = {}, .decimals = 0},
                                   {.name = "mean square", .unit = {}},
                                   {.name = "F", .unit = {}},
                                   {.name = "p", .unit = {}}},
                       .rows = {}}};
  const SurfaceVariances& anova = regression.anova;
  add_variance(table.data, "model", anova.model);
  for (const SurfaceFactor& factor : regression.factors) {
    add_variance(table.data, "all terms of " + label_of(factor.name), factor.all_terms);
  }
  add_variance(table.data, "residual", anova.residual);
  add_variance(table.data, "lack of fit", anova.lack_of_fit);
  add_variance(table.data, "pure error", anova.pure_error);
  add_variance(table.data, "total", anova.total);
  return table;
}

/// "1", "restitution, particle–wall²" for terms made of the factors' names.
std::string term_shown(std::string term, const SurfaceSummary& regression) {
  for (const SurfaceFactor& factor : regression.factors) {
    const std::string& name = factor.name;
    if (name.empty()) continue;
    for (std::size_t at = term.find(name); at != std::string::npos;) {
      const std::string label = fmt::format("({})", label_of(name));
      term.replace(at, name.size(), label);
      at = term.find(name, at + label.size());
    }
  }
  return shortened(term, 160);
}

Table coefficient_table(const SurfaceSummary& regression, const std::string& of) {
  Table table{.name = file_stem("terms_" + of),
              .title = "Terms, for factors coded −1 … 1",
              .data = {.columns = {{.name = "term", .unit = {}},
                                   {.name = "value", .unit = {}},
                                   {.name = "standard error", .unit = {}},
                                   {.name = "t", .unit = {}},
                                   {.name = "p", .unit = {}},
                                   {.name = "in natural units", .unit = {}}},
                       .rows = {}}};
  for (const SurfaceTerm& term : regression.coefficients) {
    table.data.add({term_shown(term.term, regression), cell(term.value), cell(term.standard_error),
                    cell(term.t), cell(term.p), cell(term.natural)});
  }
  return table;
}

}  // namespace

void add_regression(const SurfaceSummary& regression, const std::string& of,
                    std::vector<Block>& blocks) {
  blocks.push_back(anova_table(regression, of));
  blocks.push_back(
      Paragraph{fmt::format("R² {}, adjusted {}, predicted {}; residual standard deviation {}.",
                            shown(regression.r2, 3), shown(regression.r2_adjusted, 3),
                            shown(regression.r2_predicted, 3), shown(regression.residual_sd))});
  for (const SurfaceDiagnostic& warning : regression.warnings) {
    blocks.push_back(Remark{shortened(warning.message, 1000)});
  }
  blocks.push_back(coefficient_table(regression, of));
}

Chapter statistics_chapter(const JointResult& joint) {
  Chapter chapter{.id = "statistics", .title = "Analysis of variance", .blocks = {}};
  for (const auto& [observable, regression] : joint.regressions) {
    chapter.blocks.push_back(Heading{titled(axis_of_observable(observable, ""))});
    if (regression) {
      add_regression(*regression, observable, chapter.blocks);
    } else {
      chapter.blocks.push_back(Paragraph{"Too few runs for a polynomial."});
    }
  }
  if (chapter.blocks.empty()) return chapter;
  const Block lead = Paragraph{
      "A polynomial fitted to the runs of each experiment, as in response-surface software. It "
      "shows "
      "which coefficients affect an experiment at all; a small p means that the effect is unlikely "
      "to be due to chance. The coefficients above were not fitted with it but with Gaussian "
      "processes, which follow curvature that a polynomial cannot."};
  chapter.blocks.insert(chapter.blocks.begin(), lead);
  return chapter;
}

}  // namespace repose::calibrate::report
