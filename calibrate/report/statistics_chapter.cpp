#include <fmt/format.h>

#include "calibrate/report/chapters.h"
#include "calibrate/report/wording.h"

namespace repose::calibrate::report {
namespace {

void add_variance(DataTable& data, const std::string& source, const JsonView& variance) {
  if (!variance.exists()) return;
  data.add({source, cell(variance["sum_of_squares"].number()), cell(variance["df"].number()),
            cell(variance["mean_square"].number()), cell(variance["f"].number()),
            cell(variance["p"].number())});
}

Table anova_table(const JsonView& regression, const std::string& of) {
  Table table{.name = file_stem("anova_" + of),
              .title = "Analysis of variance",
              .data = {.columns = {{.name = "source", .unit = {}},
                                   {.name = "sum of squares", .unit = {}},
                                   {.name = "df", .unit = {}, .decimals = 0},
                                   {.name = "mean square", .unit = {}},
                                   {.name = "F", .unit = {}},
                                   {.name = "p", .unit = {}}},
                       .rows = {}}};
  const JsonView anova = regression["anova"];
  add_variance(table.data, "model", anova["model"]);
  for (const JsonView& factor : regression["factors"].items()) {
    add_variance(table.data, "all terms of " + label_of(factor["name"].text()),
                 factor["all_terms"]);
  }
  add_variance(table.data, "residual", anova["residual"]);
  add_variance(table.data, "lack of fit", anova["lack_of_fit"]);
  add_variance(table.data, "pure error", anova["pure_error"]);
  add_variance(table.data, "total", anova["total"]);
  return table;
}

/// "1", "restitution, particle–wall²" for terms made of the factors' names.
std::string term_shown(std::string term, const JsonView& regression) {
  for (const JsonView& factor : regression["factors"].items()) {
    const std::string name = factor["name"].text();
    if (name.empty()) continue;
    for (std::size_t at = term.find(name); at != std::string::npos;) {
      const std::string label = fmt::format("({})", label_of(name));
      term.replace(at, name.size(), label);
      at = term.find(name, at + label.size());
    }
  }
  return shortened(term, 160);
}

Table coefficient_table(const JsonView& regression, const std::string& of) {
  Table table{.name = file_stem("terms_" + of),
              .title = "Terms, for factors coded −1 … 1",
              .data = {.columns = {{.name = "term", .unit = {}},
                                   {.name = "value", .unit = {}},
                                   {.name = "standard error", .unit = {}},
                                   {.name = "t", .unit = {}},
                                   {.name = "p", .unit = {}},
                                   {.name = "in natural units", .unit = {}}},
                       .rows = {}}};
  for (const JsonView& term : regression["coefficients"].items()) {
    table.data.add({term_shown(term["term"].text(), regression), cell(term["value"].number()),
                    cell(term["standard_error"].number()), cell(term["t"].number()),
                    cell(term["p"].number()), cell(term["natural"].number())});
  }
  return table;
}

}  // namespace

void add_regression(const JsonView& regression, const std::string& of, std::vector<Block>& blocks) {
  blocks.push_back(anova_table(regression, of));
  blocks.push_back(Paragraph{fmt::format(
      "R² {}, adjusted {}, predicted {}; residual standard deviation {}.",
      shown(regression["r2"].number(), 3), shown(regression["r2_adjusted"].number(), 3),
      shown(regression["r2_predicted"].number(), 3), shown(regression["residual_sd"].number()))});
  for (const JsonView& warning : regression["warnings"].items()) {
    blocks.push_back(Remark{shortened(warning["message"].text(), 1000)});
  }
  blocks.push_back(coefficient_table(regression, of));
}

Chapter statistics_chapter(const StudyFolder& study) {
  Chapter chapter{.id = "statistics", .title = "Analysis of variance", .blocks = {}};
  for (const JsonView& item : study.result["regressions"].items()) {
    const std::string observable = item["observable"].text();
    const JsonView regression = item["regression"];
    chapter.blocks.push_back(Heading{titled(axis_of_observable(observable, ""))});
    if (!regression.exists()) {
      chapter.blocks.push_back(Paragraph{"Too few runs for a polynomial."});
      continue;
    }
    add_regression(regression, observable, chapter.blocks);
  }
  if (chapter.blocks.empty()) return chapter;
  const Block lead = Paragraph{
      "A polynomial through each experiment's runs, as a response-surface program would fit it. "
      "The coefficients above were not found with it, but with Gaussian processes, which follow "
      "bends that a polynomial cannot; it shows which coefficients move an experiment at all. A "
      "small p says that chance alone would hardly do it."};
  chapter.blocks.insert(chapter.blocks.begin(), lead);
  return chapter;
}

}  // namespace repose::calibrate::report
