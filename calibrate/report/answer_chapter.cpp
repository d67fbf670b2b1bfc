#include <fmt/format.h>

#include "calibrate/report/chapters.h"
#include "calibrate/report/wording.h"
#include "calibrate/result/agreement_text.h"
#include "calibrate/result/bench_errors_text.h"
#include "calibrate/result/summary_text.h"

namespace repose::calibrate::report {
namespace {

/// "determined if single readings of roll scatter by 35 %".
std::string conditional_verdict(const JointResult& joint, const ResultParameter& parameter) {
  const std::string condition = condition_text(joint, parameter);
  return name_of(parameter.verdict) + (condition.empty() ? "" : ' ' + condition);
}

constexpr std::size_t kLongestSentence = 2000;

/// To be read on any screen and pasted into any document: short cells of plain text. Numbers of the
/// same are in uncertainty_table().
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

/// Where coefficients have no value of their own, what can be used in their place.
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
  for (const std::string& sentence : summary_sentences(joint)) {
    chapter.blocks.push_back(Paragraph{shortened(sentence, kLongestSentence)});
  }
  const bool sets_first = has_open_coefficients(joint);
  if (sets_first) add_sets(joint, chapter);
  chapter.blocks.push_back(answer_table(joint));
  for (const ResultParameter& parameter : joint.parameters) {
    const std::string text = bounds_text(parameter);
    if (text.empty()) continue;
    chapter.blocks.push_back(Remark{titled(label_of(parameter.name)) + ": " + text + '.'});
  }
  if (!sets_first) add_sets(joint, chapter);
  PictureRow row = heaps_side_by_side(pictures);
  if (!row.pictures.empty()) chapter.blocks.push_back(std::move(row));
  chapter.blocks.push_back(Paragraph{
      "These coefficients are valid only with their clump, contact model, damping, stiffness and "
      "time step, which are listed under “Provenance”. In another program the same number may have "
      "a different meaning."});
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
  return chapter;
}

}  // namespace repose::calibrate::report
