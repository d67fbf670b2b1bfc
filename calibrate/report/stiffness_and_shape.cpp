#include <string>
#include <vector>

#include <fmt/format.h>

#include "calibrate/report/chapters.h"
#include "calibrate/report/wording.h"
#include "calibrate/result/result_text.h"

// The effect of stiffer grains, and of grains made of more spheres.

namespace repose::calibrate::report {
namespace {

/// Wording for the check of an assumed input.
struct SensitivityWords {
  std::string table;  ///< name of the table's file
  std::string title;
  Column input;              ///< column of the input's values
  std::string explanation;   ///< of the changes
  std::string coefficients;  ///< name of their table
  std::string heading;       ///< title of their table
  std::string use;           ///< and the grains to use them with
};

Table brief_sensitivity_table(const std::vector<SensitivityCheck>& readings,
                              const SensitivityWords& words) {
  Table table{.name = {},
              .title = words.title + "; ± is the half-width of the 95 % interval",
              .data = {.columns = {{.name = "measured quantity", .unit = {}},
                                   {.name = "change", .unit = {}},
                                   {.name = "±", .unit = {}},
                                   {.name = "limit", .unit = {}},
                                   {.name = "verdict", .unit = {}}},
                       .rows = {}}};
  for (const SensitivityCheck& check : readings) {
    table.data.add({axis_of_observable(check.name, check.unit), cell(check.change),
                    cell((check.interval.high - check.interval.low) / 2), cell(check.limit),
                    name_of(check.verdict)});
  }
  return table;
}

Table sensitivity_table(const std::vector<SensitivityCheck>& readings,
                        const SensitivityWords& words) {
  Table table{.name = words.table,
              .title = words.title,
              .data = {.columns = {{.name = "measured quantity", .unit = {}},
                                   words.input,
                                   {.name = "change", .unit = {}},
                                   {.name = "95 % from", .unit = {}},
                                   {.name = "95 % to", .unit = {}},
                                   {.name = "p", .unit = "%", .decimals = 2},
                                   {.name = "limit", .unit = {}},
                                   {.name = "verdict", .unit = {}}},
                       .rows = {}}};
  for (const SensitivityCheck& check : readings) {
    table.data.add({axis_of_observable(check.name, check.unit), cell(check.value),
                    cell(check.change), cell(check.interval.low), cell(check.interval.high),
                    cell(100 * check.chance), cell(check.limit), name_of(check.verdict)});
  }
  return table;
}

Table moved_coefficients_table(const std::vector<MovedCoefficient>& coefficients,
                               const SensitivityWords& words) {
  Table table{.name = words.coefficients,
              .title = words.heading,
              .data = {.columns = {{.name = "coefficient", .unit = {}},
                                   {.name = "value", .unit = {}, .decimals = 3},
                                   {.name = "95 % from", .unit = {}, .decimals = 3},
                                   {.name = "95 % to", .unit = {}, .decimals = 3},
                                   {.name = "verdict", .unit = {}}},
                       .rows = {}}};
  for (const MovedCoefficient& one : coefficients) {
    table.data.add({label_of(one.name), cell(one.value), cell(one.interval.low),
                    cell(one.interval.high), name_of(one.verdict)});
  }
  return table;
}

void add_sensitivity(const std::vector<SensitivityCheck>& readings,
                     const std::vector<MovedCoefficient>& coefficients,
                     const SensitivityWords& words, Chapter& chapter) {
  if (readings.empty()) return;
  chapter.blocks.push_back(brief_sensitivity_table(readings, words));
  chapter.blocks.push_back(Paragraph{fmt::format(
      "{} The limit is the half-width of the 95 % interval of the bench's mean. Agrees: the change "
      "is shown to be within it. Disagrees: it is more than chance makes, and the coefficients "
      "make up for it. Cannot tell: the change is known no better than this.",
      words.explanation)});
  if (const std::string coarse = larger_grains_text(readings); !coarse.empty()) {
    chapter.blocks.push_back(Paragraph{titled(coarse) + '.'});
  }
  if (coefficients.empty()) return;
  chapter.blocks.push_back(moved_coefficients_table(coefficients, words));
  chapter.blocks.push_back(
      Paragraph{fmt::format("Refitting with the changes above, and their uncertainty, gives these "
                            "coefficients. {}",
                            words.use)});
}

SensitivityWords stiffness_words() {
  return {.table = "stiffness_checks",
          .title = "Stiffer grains at the coefficients checked last",
          .input = {.name = "stiffness factor", .unit = {}},
          .explanation =
              "The grains of these experiments are softer than real ones, since softer "
              "grains are simulated faster. Simulated again with stiffer ones, the "
              "readings change by so much.",
          .coefficients = "stiffer_coefficients",
          .heading = "Coefficients for the stiffer grains",
          .use =
              "Use them with grains as stiff as those; with the study's softer grains use the "
              "coefficients of the answer."};
}

SensitivityWords shape_words(const ShapeCheck& shape) {
  return {.table = "shape_check",
          .title = "More spheres at the coefficients checked last",
          .input = {.name = "spheres", .unit = {}, .decimals = 0},
          .explanation = fmt::format(
              "The coefficients belong to a clump of this many spheres: {}. Simulated again with "
              "more, which follow the surface closer{} and touch in more places at once, the "
              "readings change by so much.",
              shape.spheres,
              shape.finer_volume_error
                  ? fmt::format(" (volume error {:.1f} %)", 100 * *shape.finer_volume_error)
                  : ""),
          .coefficients = "finer_coefficients",
          .heading = "Coefficients for more spheres",
          .use =
              "Use them with a grain of that many spheres; with the study's use the "
              "coefficients of the answer."};
}

void add_stiffness(const JointResult& joint, Chapter& chapter) {
  add_sensitivity(joint.stiffness_checks, joint.stiffer_coefficients, stiffness_words(), chapter);
}

void add_shape(const JointResult& joint, Chapter& chapter) {
  if (!joint.shape_check) return;  // result of an earlier version
  const ShapeCheck& shape = *joint.shape_check;
  add_sensitivity(shape.readings, shape.coefficients, shape_words(shape), chapter);
  const std::string open = shape_check_text(shape);
  if (!open.empty()) chapter.blocks.push_back(Paragraph{open});
}

}  // namespace

void add_stiffness_and_shape(const JointResult& joint, Chapter& chapter) {
  add_stiffness(joint, chapter);
  add_shape(joint, chapter);
}

void add_stiffness_and_shape_tables(const JointResult& joint, Chapter& chapter) {
  if (!joint.stiffness_checks.empty()) {
    chapter.blocks.push_back(sensitivity_table(joint.stiffness_checks, stiffness_words()));
  }
  if (joint.shape_check && !joint.shape_check->readings.empty()) {
    chapter.blocks.push_back(
        sensitivity_table(joint.shape_check->readings, shape_words(*joint.shape_check)));
  }
}

}  // namespace repose::calibrate::report
