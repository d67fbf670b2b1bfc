#include "cli/compare/compare_table.h"

#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/common/degrees.h"
#include "cli/common/table.h"
#include "cli/compare/angle_cells.h"
#include "cli/compare/compare_names.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

using Angle = std::optional<double>;
using Cells = std::array<Angle, 2>;

/// Lengths as they are shown: in mm, or in % without a scale.
class Lengths {
 public:
  explicit Lengths(vision::LengthUnit unit) : is_metric_(unit == vision::LengthUnit::metre) {}

  std::string cell(const Angle& length) const {
    if (!length) return kNothing;
    const std::string text = fmt::format("{:.2f}", *length * (is_metric_ ? 1000 : 100));
    return text == "-0.00" ? "0.00" : text;
  }
  std::vector<std::string> row(std::string_view name, const std::array<Angle, 3>& lengths) const {
    return {fmt::format("{} [{}]", name, unit()), cell(lengths[0]), cell(lengths[1]),
            cell(lengths[2])};
  }
  /// A length of each heap, and the first minus the second.
  std::vector<std::string> pair_row(std::string_view name, const Cells& pair) const {
    const Angle difference = pair[0] && pair[1] ? Angle(*pair[0] - *pair[1]) : std::nullopt;
    return row(name, {pair[0], pair[1], difference});
  }
  const char* unit() const { return is_metric_ ? "mm" : "%"; }

 private:
  bool is_metric_;
};

/// A name and three columns of numbers, as wide in all tables of the comparison.
Table comparison_table(const std::array<const char*, 4>& headings) {
  constexpr std::size_t kNameWidth = 24, kCellWidth = 14;
  std::vector<Column> columns = {{.heading = headings[0], .min_width = kNameWidth}};
  for (const std::size_t i : {1, 2, 3}) {
    columns.push_back({.heading = headings[i], .align = Align::right, .min_width = kCellWidth});
  }
  return Table(std::move(columns));
}

std::string fraction(const Angle& cell) { return cell ? fmt::format("{:.3f}", *cell) : kNothing; }

std::string verdict_text(const std::optional<vision::AngleDifference>& angle, double margin_rad) {
  if (!angle) return "cannot tell: an angle is refused. The outlines are compared all the same.";
  const double margin = to_degrees(margin_rad);
  switch (angle->verdict) {
    case vision::Agreement::equivalent:
      return fmt::format("equivalent: the angles differ by less than {:g}°", margin);
    case vision::Agreement::different:
      return fmt::format("different: the interval excludes 0 and is not within ±{:g}°", margin);
    case vision::Agreement::cannot_tell:
      break;
  }
  return fmt::format(
      "cannot tell: the interval includes 0, but also more than {:g}°. Take larger heaps, or "
      "several of each, and compare the means of repose measure.",
      margin);
}

std::string outlines_text(const ComparePlan& plan, const vision::HeapComparison& comparison,
                          int columns) {
  const Lengths lengths(comparison.unit);
  const vision::SideComparison& left = comparison.left;
  const vision::SideComparison& right = comparison.right;
  Table table = comparison_table({"outlines", "all", "left", "right"});
  table.add_row(
      {"overlap (IoU)", fraction(comparison.iou), fraction(left.iou), fraction(right.iou)});
  table.add_row(lengths.row("height, root mean sq.",
                            {comparison.profile_rmse, left.profile_rmse, right.profile_rmse}));
  table.add_row(lengths.row("height, mean",
                            {comparison.profile_mean, left.profile_mean, right.profile_mean}));
  table.add_row(
      lengths.row("Hausdorff distance", {comparison.hausdorff, std::nullopt, std::nullopt}));
  table.add_row(
      lengths.row("  of 95 % of the edge", {comparison.hausdorff_95, std::nullopt, std::nullopt}));
  if (plan.grain_m && comparison.unit == vision::LengthUnit::metre) {
    table.add_note("", fmt::format("In grain sizes, the root mean square is {:.2f}.",
                                   *comparison.profile_rmse / *plan.grain_m));
  }
  table.add_note("", fmt::format("Aligned by {}. Moved by {} {}, the second heap would fit best: "
                                 "root mean square {} {}.",
                                 comparison.is_aligned_by_crest ? "crest" : "axis",
                                 lengths.cell(comparison.best_shift), lengths.unit(),
                                 lengths.cell(comparison.best_shift_rmse), lengths.unit()));
  return table.text(columns);
}

std::string measured_text(const ComparePlan& plan, const vision::HeapComparison& comparison,
                          int columns) {
  const Lengths lengths(comparison.unit);
  const auto& angle = comparison.angle_rad;
  const auto& uncertainty = comparison.uncertainty_rad;
  Table table = comparison_table({"", "first", "second", "difference"});
  table.add_row({"angle [°]", angle_cell(angle[0], uncertainty[0]),
                 angle_cell(angle[1], uncertainty[1]), difference_cell(comparison.angle)});
  table.add_row({"  left sides [°]", "", "", difference_cell(comparison.left.angle)});
  table.add_row({"  right sides [°]", "", "", difference_cell(comparison.right.angle)});
  table.add_row(lengths.pair_row("height", comparison.height));
  table.add_row(lengths.pair_row("base", comparison.base));
  table.add_row(lengths.pair_row("  left of the axis", comparison.left.run_out));
  table.add_row(lengths.pair_row("  right of the axis", comparison.right.run_out));
  table.add_note("", verdict_text(comparison.angle, plan.comparing.margin_rad));
  return table.text(columns);
}

std::string warnings_text(const vision::HeapComparison& comparison, int columns) {
  std::string text;
  if (comparison.status == vision::MeasureStatus::flagged) {
    text +=
        paragraph("! ", "A picture is in doubt: look at it before you use the verdict.", columns);
  }
  for (const vision::CompareWarning& warning : comparison.warnings) {
    const char* whose = !warning.picture        ? "! "
                        : *warning.picture == 0 ? "! first: "
                                                : "! second: ";
    text += paragraph(whose, warning.warning.message, columns);
  }
  return text;
}

}  // namespace

std::string compare_table(const ComparePlan& plan, const vision::HeapComparison& comparison,
                          int columns) {
  std::string text = paragraph("first   ", plan.sources[0].name, columns) +
                     paragraph("second  ", plan.sources[1].name, columns);
  if (comparison.status == vision::MeasureStatus::refused) {
    return text + paragraph("refused: ", comparison.reason, columns);
  }
  text += measured_text(plan, comparison, columns);
  if (comparison.iou) text += '\n' + outlines_text(plan, comparison, columns);
  if (comparison.unit == vision::LengthUnit::root_area) {
    text += paragraph("", "Lengths are in % of the square root of a silhouette's area.", columns);
  } else if (comparison.unit == vision::LengthUnit::height) {
    text += paragraph("", "Lengths are in % of a heap's height.", columns);
  }
  return text + warnings_text(comparison, columns);
}

}  // namespace repose::cli
