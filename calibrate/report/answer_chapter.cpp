#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "calibrate/fit/solution.h"
#include "calibrate/report/chapters.h"
#include "calibrate/report/document.h"
#include "calibrate/report/wording.h"
#include "calibrate/result/result_text.h"

namespace repose::calibrate::report {

namespace {

/// "determined if single readings of roll scatter by 35 %".
std::string conditional_verdict(const JointResult& joint, const ResultParameter& parameter) {
  const std::string condition = condition_text(joint, parameter);
  return name_of(parameter.verdict) + (condition.empty() ? "" : ' ' + condition);
}

constexpr std::size_t kLongestSentence = 2000;

/// For reading on any screen and pasting into any document: short cells of plain text. Its numbers
/// are in uncertainty_table().
Table answer_table(const JointResult& joint) {
  Table table{.name = {},
              .title = has_open_coefficients(joint)
                           ? "Coefficients one by one: an interval says nothing of which values "
                             "go together"
                           : "Contact coefficients",
              .data = {.columns = {{.name = "coefficient", .unit = {}},
                                   {.name = "value", .unit = {}, .decimals = 3},
                                   {.name = "95 % interval", .unit = {}},
                                   {.name = "verdict", .unit = {}}},
                       .rows = {}}};
  for (const ResultParameter& parameter : joint.parameters) {
    table.data.add({label_of(parameter.name), cell(parameter.value),
                    fmt::format("{} to {}", shown(parameter.interval.low, 3),
                                shown(parameter.interval.high, 3)),
                    conditional_verdict(joint, parameter)});
  }
  return table;
}

Table sets_table(const JointResult& joint) {
  Table table{.name = "equivalence_sets",
              .title = "Equally good sets, the best one first",
              .data = {.columns = {{.name = "set", .unit = {}, .decimals = 0}}, .rows = {}}};
  for (const ResultParameter& parameter : joint.parameters) {
    table.data.columns.push_back({.name = label_of(parameter.name), .unit = {}, .decimals = 3});
  }
  table.data.columns.push_back({.name = "χ² above the minimum", .unit = {}, .decimals = 2});
  table.data.columns.push_back({.name = "simulated", .unit = {}});
  double number = 0;
  for (const EquivalentSet& set : good_sets(joint)) {
    std::vector<Cell> row = {++number};
    for (const double value : set.values) row.push_back(cell(value));
    row.push_back(cell(set.chi2));
    row.emplace_back(set.verdict ? name_of(*set.verdict) : std::string("not checked"));
    table.data.add(std::move(row));
  }
  return table;
}

/// If coefficients are not determined individually, the sets that can be used instead.
void add_sets(const JointResult& joint, Chapter& chapter) {
  if (joint.equivalence_family.empty()) return;
  if (has_open_coefficients(joint)) chapter.blocks.push_back(Remark{kUseOneRow});
  chapter.blocks.push_back(sets_table(joint));
}

/// Sentences of the advice, each once.
std::vector<std::string> advice_of(const JointResult& joint) {
  std::vector<std::string> advice;
  for (const ResultParameter& parameter : joint.parameters) {
    if (parameter.advice.empty()) continue;
    advice.push_back(title_of_parameter(parameter.name) + ": " + shortened(parameter.advice, 1000));
  }
  return advice;
}

/// One after another, separated by blank lines.
std::string lines_of(const std::vector<StudyAddition>& additions) {
  std::string lines;
  for (const StudyAddition& addition : additions) {
    lines += (lines.empty() ? "" : "\n") + addition.lines;
  }
  return lines;
}

}  // namespace

PictureRow heaps_side_by_side(const HeapPictures& pictures) {
  PictureRow row;
  if (pictures.best_photograph) {
    row.pictures.push_back(pictures.photographs[*pictures.best_photograph]);
  }
  if (pictures.look) row.pictures.push_back(*pictures.look);
  if (row.pictures.size() < 2 && !pictures.renders.empty()) {
    row.pictures.push_back(pictures.renders[pictures.best_render]);
  }
  return row;
}

Chapter answer_chapter(const JointResult& joint, const HeapPictures& pictures) {
  Chapter chapter{.id = "answer", .title = "The answer", .blocks = {}};
  for (const std::string& sentence : summary_sentences(joint)) {
    chapter.blocks.push_back(Paragraph{shortened(sentence, kLongestSentence)});
  }
  const bool sets_first = has_open_coefficients(joint);
  if (sets_first) add_sets(joint, chapter);
  chapter.blocks.push_back(answer_table(joint));
  for (const ResultParameter& parameter : joint.parameters) {
    const std::string text = bounds_text(parameter);
    if (text.empty()) continue;
    chapter.blocks.push_back(Remark{title_of_parameter(parameter.name) + ": " + text + '.'});
  }
  if (!sets_first) add_sets(joint, chapter);
  PictureRow row = heaps_side_by_side(pictures);
  if (!row.pictures.empty()) chapter.blocks.push_back(std::move(row));
  chapter.blocks.push_back(Paragraph{
      !joint.is_of_table
          ? "These coefficients are valid only with their clump, contact model, damping, stiffness "
            "and time step, which are listed under “Provenance”. In another program the same "
            "number may have a different meaning."
          : "These parameters are valid only with the program, particles, contact model, stiffness "
            "and time step that the runs of the table were made with."});
  const std::vector<std::string> advice = advice_of(joint);
  if (!advice.empty()) {
    chapter.blocks.push_back(Heading{"How to determine the others"});
    for (const std::string& text : advice) chapter.blocks.push_back(Remark{text});
    if (!joint.additions.empty()) {
      chapter.blocks.push_back(CodeText{
          !joint.is_of_table ? "For the study file (repose plan tells what each would give)"
                             : "For the study file, with a table of what the bench read",
          lines_of(joint.additions)});
    }
  }
  return chapter;
}

namespace {

Chart profile_chart(const ResultParameter& parameter) {
  const std::string label = label_of(parameter.name);
  Chart chart =
      plane_chart("profile_" + parameter.name, title_of_parameter(parameter.name),
                  {.name = label, .unit = {}}, {.name = "χ² above the minimum", .unit = {}});
  std::vector<ProfilePoint> points;
  for (const ProfilePoint& point : parameter.profile) {
    if (std::isfinite(point.value + point.chi2)) points.push_back(point);
  }
  std::sort(points.begin(), points.end(),
            [](const ProfilePoint& a, const ProfilePoint& b) { return a.value < b.value; });
  if (points.empty()) return chart;
  for (const auto& [value, chi2] : points) {
    add_point(chart, "others refitted", Look::points, value, chi2);
  }
  add_level(chart, "95 % limit", Look::limit, {points.front().value, points.back().value},
            kChi2Limit, kChi2Limit, kChi2Limit);
  add_point(chart, "best fit", Look::best, cell(parameter.value), 0.0, cell(parameter.interval.low),
            cell(parameter.interval.high));
  constexpr double kShown = 12;
  chart.y_range = {{-0.8, kShown}};
  chart.caption = parameter.verdict == Verdict::determined
                      ? "It rises above the limit on both sides: determined."
                  : parameter.verdict == Verdict::bounded
                      ? "It rises above the limit on both sides, far apart: bounded."
                  : parameter.verdict == Verdict::one_sided
                      ? "It rises above the limit on one side only: one-sided."
                      : "It stays below the limit nearly everywhere: undetermined.";
  return chart;
}

Chart family_chart(const JointResult& joint) {
  Chart chart =
      plane_chart("equivalence_family", "Where the equally good sets lie between the bounds",
                  {.name = "coefficient", .unit = {}},
                  {.name = "position between the bounds, 0 … 1", .unit = {}});
  chart.x_title = "";
  chart.y_range = {{-0.05, 1.05}};
  chart.caption =
      "Each line is one set of coefficients whose misfit is within the 95 % limit. Where the lines "
      "meet, the measurements determine the coefficient; where they spread, they do not.";
  const auto add = [&](const std::string& series, std::size_t k, double value) {
    const ResultParameter& parameter = joint.parameters[k];
    add_point(
        chart, series, Look::line, label_of(parameter.name),
        cell((value - parameter.bounds.low) / (parameter.bounds.high - parameter.bounds.low)));
  };
  int number = 0;
  for (const EquivalentSet& set : good_sets(joint)) {
    const std::string series = fmt::format("set {}", ++number);
    for (std::size_t k = 0; k < set.values.size(); ++k) add(series, k, set.values[k]);
  }
  return chart;
}

/// The answer in numbers, between the bounds.
Table uncertainty_table(const JointResult& joint) {
  Table table{.name = "coefficients",
              .title = "Contact coefficients with 95 % intervals",
              .data = {.columns = {{.name = "coefficient", .unit = {}},
                                   {.name = "value", .unit = {}, .decimals = 3},
                                   {.name = "95 % from", .unit = {}, .decimals = 3},
                                   {.name = "95 % to", .unit = {}, .decimals = 3},
                                   {.name = "lower bound", .unit = {}},
                                   {.name = "upper bound", .unit = {}},
                                   {.name = "verdict", .unit = {}}},
                       .rows = {}},
              .strip = {{1, 2, 3, 4, 5}}};
  for (const ResultParameter& parameter : joint.parameters) {
    table.data.add({label_of(parameter.name), cell(parameter.value), cell(parameter.interval.low),
                    cell(parameter.interval.high), cell(parameter.bounds.low),
                    cell(parameter.bounds.high), name_of(parameter.verdict)});
  }
  return table;
}

/// How more computing and more measurements would change the widths of the intervals.
Table narrowing_table(const JointResult& joint) {
  Table table{.name = "narrowing",
              .title = "Width of the 95 % interval: current and predicted",
              .data = {.columns = {{.name = "coefficient", .unit = {}},
                                   {.name = "now", .unit = {}, .decimals = 3},
                                   {.name = "exact simulation", .unit = {}, .decimals = 3},
                                   {.name = "four times the readings", .unit = {}, .decimals = 3}},
                       .rows = {}}};
  // For another program, the number of runs per hour is unknown.
  const bool has_hours = std::ranges::any_of(joint.parameters, [](const ResultParameter& one) {
    return one.narrowing && one.narrowing->hour;
  });
  if (has_hours) {
    table.data.columns.insert(table.data.columns.begin() + 2,
                              {.name = "one more core hour", .unit = {}, .decimals = 3});
  }
  for (const ResultParameter& parameter : joint.parameters) {
    if (!parameter.narrowing) continue;
    const double width = parameter.interval.high - parameter.interval.low;
    std::vector<Cell> row = {label_of(parameter.name), cell(width)};
    if (has_hours) row.push_back(cell(width * parameter.narrowing->hour.value_or(1)));
    row.push_back(cell(width * parameter.narrowing->exact));
    row.push_back(cell(width * parameter.narrowing->readings));
    table.data.add(std::move(row));
  }
  return table;
}

void add_narrowing(const JointResult& joint, Chapter& chapter) {
  Table table = narrowing_table(joint);
  if (table.data.rows.empty()) return;
  chapter.blocks.push_back(Heading{"What would narrow the intervals"});
  chapter.blocks.push_back(std::move(table));
  chapter.blocks.push_back(
      Paragraph{fmt::format("Roughly foreseen from the fit. Where exact simulation would hardly "
                            "narrow an interval, {} no "
                            "use: measure more, or another experiment.",
                            !joint.is_of_table ? "a larger budget is" : "more runs are")});
}

Table correlation_table(const JointResult& joint) {
  Table table{
      .name = "correlation",
      .title = "Correlation of the coefficients (1 or −1: only a combination is determined)",
      .data = {}};
  table.data.columns = {{.name = "coefficient", .unit = {}}};
  for (const ResultParameter& parameter : joint.parameters) {
    table.data.columns.push_back({.name = label_of(parameter.name), .unit = {}, .decimals = 2});
  }
  for (std::size_t k = 0; k < joint.correlation.size(); ++k) {
    std::vector<Cell> row = {label_of(joint.parameters[k].name)};
    for (const double value : joint.correlation[k]) row.push_back(cell(value));
    table.data.add(std::move(row));
  }
  return table;
}

}  // namespace

Chapter knowledge_chapter(const JointResult& joint) {
  Chapter chapter{.id = "knowledge", .title = "Uncertainty", .blocks = {}};
  chapter.blocks.push_back(uncertainty_table(joint));
  if (!joint.equivalence_family.empty()) {
    chapter.blocks.push_back(ChartRow{{family_chart(joint)}});
  }
  ChartRow profiles;
  for (const ResultParameter& parameter : joint.parameters) {
    Chart chart = profile_chart(parameter);
    if (!chart.data.rows.empty()) profiles.charts.push_back(std::move(chart));
  }
  if (!profiles.charts.empty()) {
    chapter.blocks.push_back(Heading{"Profile likelihoods"});
    chapter.blocks.push_back(Paragraph{fmt::format(
        "Each coefficient is fixed at one value after another while all others are refitted. The "
        "values at which the misfit χ² rises by less than {:.2f} form the 95 % interval. Where few "
        "readings tell the bench's scatter another rise ends it, and χ² is shown in units of that.",
        kChi2Limit)});
    chapter.blocks.push_back(std::move(profiles));
  }
  if (!joint.correlation.empty()) {
    chapter.blocks.push_back(Heading{"Correlations"});
    chapter.blocks.push_back(correlation_table(joint));
  }
  add_narrowing(joint, chapter);
  return chapter;
}

}  // namespace repose::calibrate::report
