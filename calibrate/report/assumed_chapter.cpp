#include <fmt/format.h>
#include <fmt/ranges.h>

#include "calibrate/report/chapters.h"
#include "calibrate/report/wording.h"

namespace repose::calibrate::report {

namespace {

/// Each input with the coefficients that it affects.
Table inputs_table(const JointResult& joint) {
  Table table{.name = "assumed_inputs",
              .title = "Each by itself, larger by its standard uncertainty",
              .data = {.columns = {{.name = "input", .unit = {}},
                                   {.name = "value", .unit = {}},
                                   {.name = "standard uncertainty", .unit = {}},
                                   {.name = "source", .unit = {}}},
                       .rows = {}}};
  for (const CombinedEffect& one : joint.with_assumed) {
    table.data.columns.push_back({.name = "moves " + label_of(one.name), .unit = {}});
  }
  for (const InputEffect& input : joint.assumed_inputs) {
    const std::string unit = input.unit.empty() ? "" : fmt::format(" [{}]", input.unit);
    std::vector<Cell> row = {input.input + unit, cell(input.value), cell(input.sd),
                             std::string(input.is_assumed ? "assumed" : "stated")};
    for (std::size_t j = 0; j < joint.with_assumed.size(); ++j) {
      row.push_back(input.coefficients.empty() ? Cell{} : cell(input.coefficients[j].change));
    }
    table.data.add(std::move(row));
  }
  return table;
}

Table combined_table(const JointResult& joint) {
  Table table{
      .name = "with_assumed",
      .title = "With what was assumed",
      .data = {.columns = {{.name = "coefficient", .unit = {}},
                           {.name = "value", .unit = {}, .decimals = 3},
                           {.name = "half-width of its 95 % interval", .unit = {}},
                           {.name = "all inputs, 95 %", .unit = {}},
                           {.name = "with what was assumed from", .unit = {}, .decimals = 3},
                           {.name = "to", .unit = {}, .decimals = 3}},
               .rows = {}}};
  for (const CombinedEffect& one : joint.with_assumed) {
    table.data.add({label_of(one.name), cell(one.value), cell(one.half_width), cell(one.effect),
                    cell(one.interval.low), cell(one.interval.high)});
  }
  return table;
}

std::string not_varied_text(const JointResult& joint) {
  std::string text;
  for (const InputEffect& input : joint.assumed_inputs) {
    if (input.not_varied.empty()) continue;
    text +=
        fmt::format("{}{} ({})", text.empty() ? "Not simulated, and counted as no change: " : "; ",
                    input.input, fmt::join(input.not_varied, ", "));
  }
  return text.empty() ? text : text + '.';
}

}  // namespace

Chapter assumed_chapter(const JointResult& joint) {
  Chapter chapter{.id = "assumed", .title = "What we assumed, and what it moves", .blocks = {}};
  if (joint.assumed_inputs.empty()) return chapter;
  chapter.blocks.push_back(Paragraph{
      "These inputs are in no fit. Each was changed by its standard uncertainty at the "
      "coefficients that were checked last, with the same seeds; the fit was then made again of "
      "readings that differ by as much. Assumed: the study states no uncertainty, and a usual one "
      "was taken."});
  if (!joint.with_assumed.empty()) {
    chapter.blocks.push_back(inputs_table(joint));
    chapter.blocks.push_back(combined_table(joint));
    chapter.blocks.push_back(Paragraph{
        "The intervals of the answer do not hold this. All inputs: 1.96 times the root of the sum "
        "of squares."});
  }
  if (const std::string text = not_varied_text(joint); !text.empty()) {
    chapter.blocks.push_back(Remark{text});
  }
  if (!joint.inputs_taken_as_exact.empty()) {
    chapter.blocks.push_back(
        Paragraph{fmt::format("Taken as exact, since the study states no uncertainty: {}.",
                              fmt::join(joint.inputs_taken_as_exact, ", "))});
  }
  return chapter;
}

void add_assumed_scatter(const JointResult& joint, std::vector<Block>& blocks) {
  const AssumedScatters& assumed = joint.assumed_scatters;
  if (assumed.readings.empty()) return;
  std::string readings;
  for (const AssumedScatter& one : assumed.readings) {
    readings += fmt::format("{}{} {:.2g} %", readings.empty() ? "" : ", ", one.observable,
                            100 * one.fraction);
  }
  Table table{.name = "assumed_scatter",
              .title = "With half and with twice the assumed scatter",
              .data = {.columns = {{.name = "coefficient", .unit = {}},
                                   {.name = "scatter", .unit = {}},
                                   {.name = "95 % from", .unit = {}, .decimals = 3},
                                   {.name = "95 % to", .unit = {}, .decimals = 3},
                                   {.name = "verdict", .unit = {}}},
                       .rows = {}}};
  for (const ScatterDependence& coefficient : assumed.coefficients) {
    for (const auto& [scatter, one] :
         {std::pair{"half", &coefficient.half}, std::pair{"twice", &coefficient.twice}}) {
      table.data.add({label_of(coefficient.name), std::string(scatter), cell(one->interval.low),
                      cell(one->interval.high), name_of(one->verdict)});
    }
  }
  blocks.push_back(Heading{"What an assumed scatter decides"});
  blocks.push_back(Paragraph{fmt::format(
      "Nobody measured how single readings of these scatter; the fit assumes: {}. The same "
      "simulations were fitted again with half and with twice of that. Where a verdict changes, "
      "measure the scatter: five readings or more, each of them written down.",
      readings)});
  blocks.push_back(std::move(table));
}

}  // namespace repose::calibrate::report
