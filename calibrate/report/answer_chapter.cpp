#include <algorithm>

#include <fmt/format.h>

#include "calibrate/report/chapters.h"
#include "calibrate/report/wording.h"
#include "calibrate/result/agreement_text.h"
#include "calibrate/result/bench_errors_text.h"

namespace repose::calibrate::report {
namespace {

std::string verdicts_text(const JointResult& joint) {
  const auto with = [&](Verdict verdict) {
    return std::count_if(
        joint.parameters.begin(), joint.parameters.end(),
        [&](const ResultParameter& parameter) { return parameter.verdict == verdict; });
  };
  const auto determined = with(Verdict::determined);
  const auto all = static_cast<long>(joint.parameters.size());
  std::string text =
      determined == all
          ? fmt::format("All {} coefficients are determined by these measurements.", all)
          : fmt::format("{} of {} coefficients are determined by these measurements.", determined,
                        all);
  if (const auto bounded = with(Verdict::bounded); bounded > 0) {
    text += fmt::format(" {} {} bounded: known to an interval, not to a value; use the interval.",
                        bounded, bounded == 1 ? "is" : "are");
  }
  if (const auto one_sided = with(Verdict::one_sided); one_sided > 0) {
    text += fmt::format(" For {}, only one end of the interval is determined.", one_sided);
  }
  if (const auto open = with(Verdict::undetermined); open > 0) {
    text +=
        fmt::format(" {} cannot be determined: any value in the interval fits these data.", open);
  }
  text += fmt::format(" Simulated again with fresh seeds, {}.", joint.agreement.text);
  if (joint.verdict == AgreementVerdict::disagrees) {
    text += " Do not use these coefficients until you know why.";
  }
  return text;
}

/// "determined if single readings of roll scatter by 35 %".
std::string conditional_verdict(const JointResult& joint, const ResultParameter& parameter) {
  const std::string condition = condition_text(joint, parameter);
  return name_of(parameter.verdict) + (condition.empty() ? "" : ' ' + condition);
}

Table coefficients_table(const JointResult& joint) {
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
                    cell(parameter.bounds.high), conditional_verdict(joint, parameter)});
  }
  return table;
}

/// What computing and measuring more would do to the widths of the intervals.
Table narrowing_table(const JointResult& joint) {
  Table table{.name = "narrowing",
              .title = "Width of the 95 % interval, now and foreseen",
              .data = {.columns = {{.name = "coefficient", .unit = {}},
                                   {.name = "now", .unit = {}, .decimals = 3},
                                   {.name = "one more core hour", .unit = {}, .decimals = 3},
                                   {.name = "exact simulation", .unit = {}, .decimals = 3},
                                   {.name = "four times the readings", .unit = {}, .decimals = 3}},
                       .rows = {}}};
  for (const ResultParameter& parameter : joint.parameters) {
    if (!parameter.narrowing) continue;
    const double width = parameter.interval.high - parameter.interval.low;
    table.data.add({label_of(parameter.name), cell(width), cell(width * parameter.narrowing->hour),
                    cell(width * parameter.narrowing->exact),
                    cell(width * parameter.narrowing->readings)});
  }
  return table;
}

void add_narrowing(const JointResult& joint, Chapter& chapter) {
  Table table = narrowing_table(joint);
  if (table.data.rows.empty()) return;
  chapter.blocks.push_back(Heading{"What would narrow the intervals"});
  chapter.blocks.push_back(std::move(table));
  chapter.blocks.push_back(Paragraph{
      "Roughly foreseen from the fit. Where exact simulation would hardly narrow an interval, a "
      "larger budget is no use: measure more, or another experiment."});
}

/// Sentences of the advice, each once.
std::vector<std::string> advice_of(const JointResult& joint) {
  std::vector<std::string> advice;
  for (const ResultParameter& parameter : joint.parameters) {
    if (parameter.advice.empty()) continue;
    advice.push_back(titled(label_of(parameter.name)) + ": " + shortened(parameter.advice, 1000));
  }
  return advice;
}

/// Below each other, a blank line between them.
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
  chapter.blocks.push_back(Paragraph{verdicts_text(joint)});
  chapter.blocks.push_back(coefficients_table(joint));
  for (const ResultParameter& parameter : joint.parameters) {
    const std::string text = bounds_text(parameter);
    if (text.empty()) continue;
    chapter.blocks.push_back(Remark{titled(label_of(parameter.name)) + ": " + text + '.'});
  }
  PictureRow row = heaps_side_by_side(pictures);
  if (!row.pictures.empty()) chapter.blocks.push_back(std::move(row));
  chapter.blocks.push_back(Paragraph{
      "These coefficients are valid only with their clump, contact model, damping, stiffness and "
      "time step, "
      "which are listed under “Provenance”. In another program the same number may have a "
      "different "
      "meaning."});
  const std::vector<std::string> advice = advice_of(joint);
  if (!advice.empty()) {
    chapter.blocks.push_back(Heading{"How to determine the others"});
    for (const std::string& text : advice) chapter.blocks.push_back(Remark{text});
    if (!joint.additions.empty()) {
      chapter.blocks.push_back(
          CodeText{"For the study file (repose plan tells what each would give)",
                   lines_of(joint.additions)});
    }
  }
  add_assumed_scatter(joint, chapter.blocks);
  add_narrowing(joint, chapter);
  return chapter;
}

}  // namespace repose::calibrate::report
