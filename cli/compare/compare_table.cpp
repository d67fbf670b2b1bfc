#include "cli/compare/compare_table.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "cli/common/degrees.h"
#include "cli/common/terminal.h"
#include "cli/compare/compare_names.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

constexpr std::size_t kNameWidth = 24;
constexpr std::size_t kCellWidth = 14;
constexpr const char* kNothing = "–";

using Cell = std::optional<double>;
using Cells = std::array<Cell, 2>;

class Table {
 public:
  Table(const vision::HeapComparison& comparison, int columns)
      : is_metric_(comparison.unit == vision::LengthUnit::metre),
        columns_(static_cast<std::size_t>(std::max(40, columns))) {}

  void add_row(std::string_view name, std::string_view a, std::string_view b, std::string_view c) {
    std::string row =
        fmt::format("{}  {}  {}  {}", padded(name, kNameWidth), right_aligned(a, kCellWidth),
                    right_aligned(b, kCellWidth), right_aligned(c, kCellWidth));
    text_ += row + '\n';
  }
  void add_lengths(std::string_view name, const std::array<Cell, 3>& cells) {
    add_row(name_with_unit(name), length(cells[0]), length(cells[1]), length(cells[2]));
  }
  /// A value of each heap, and the first minus the second.
  void add_pair(std::string_view name, const Cells& pair) {
    const Cell difference = pair[0] && pair[1] ? Cell(*pair[0] - *pair[1]) : std::nullopt;
    add_lengths(name, {pair[0], pair[1], difference});
  }
  void add_line(std::string_view mark, std::string_view text) {
    std::string before(mark);
    for (const std::string& line : wrapped(text, columns_ - letters(mark))) {
      text_ += before + line + '\n';
      before = std::string(letters(mark), ' ');
    }
  }
  void add_gap() { text_ += '\n'; }

  std::string length(const Cell& cell) const {
    if (!cell) return kNothing;
    const std::string text = fmt::format("{:.2f}", *cell * (is_metric_ ? 1000 : 100));
    return text == "-0.00" ? "0.00" : text;
  }
  const char* unit() const { return is_metric_ ? "mm" : "%"; }
  const std::string& text() const { return text_; }

 private:
  std::string name_with_unit(std::string_view name) const {
    return fmt::format("{} [{}]", name, unit());
  }

  bool is_metric_;
  std::size_t columns_;
  std::string text_;
};

std::string fraction(const Cell& cell) { return cell ? fmt::format("{:.3f}", *cell) : kNothing; }

std::string angle_cell(const Cell& angle_rad, const Cell& uncertainty_rad) {
  if (!angle_rad) return kNothing;
  return fmt::format("{:.2f} ± {:.2f}", to_degrees(*angle_rad),
                     to_degrees(uncertainty_rad.value_or(0)));
}

std::string difference_cell(const vision::AngleDifference& angle) {
  const double half_width = (angle.interval_rad[1] - angle.interval_rad[0]) / 2;
  return angle_cell(angle.difference_rad, half_width);
}

std::string difference_cell(const std::optional<vision::AngleDifference>& angle) {
  return angle ? difference_cell(*angle) : kNothing;
}

void add_verdict(Table& table, const vision::AngleDifference& angle, double margin_rad) {
  const double margin = to_degrees(margin_rad);
  switch (angle.verdict) {
    case vision::Agreement::equivalent:
      table.add_line("", fmt::format("equivalent: the angles differ by less than {:g}°", margin));
      return;
    case vision::Agreement::different:
      table.add_line(
          "",
          fmt::format("different: the interval leaves out 0, and is not within ±{:g}°", margin));
      return;
    case vision::Agreement::cannot_tell:
      table.add_line("", fmt::format("cannot tell: the interval holds 0, but also more than {:g}°. "
                                     "Take larger heaps, or several of each, and compare the "
                                     "means of repose measure.",
                                     margin));
  }
}

void add_outlines(Table& table, const ComparePlan& plan, const vision::HeapComparison& comparison) {
  const vision::SideComparison& left = comparison.left;
  const vision::SideComparison& right = comparison.right;
  table.add_row("outlines", "all", "left", "right");
  table.add_row("overlap (IoU)", fraction(comparison.iou), fraction(left.iou), fraction(right.iou));
  table.add_lengths("height, root mean sq.",
                    {comparison.profile_rmse, left.profile_rmse, right.profile_rmse});
  table.add_lengths("height, mean",
                    {comparison.profile_mean, left.profile_mean, right.profile_mean});
  table.add_lengths("Hausdorff distance", {comparison.hausdorff, std::nullopt, std::nullopt});
  table.add_lengths("  of 95 % of the edge", {comparison.hausdorff_95, std::nullopt, std::nullopt});
  if (plan.grain_m && comparison.unit == vision::LengthUnit::metre) {
    table.add_line("", fmt::format("In grains, the root mean square is {:.2f}.",
                                   *comparison.profile_rmse / *plan.grain_m));
  }
  table.add_line(
      "", fmt::format("Aligned by {}. Moved by {} {}, the second heap would fit best: root mean "
                      "square {} {}.",
                      comparison.is_aligned_by_crest ? "crest" : "axis",
                      table.length(comparison.best_shift), table.unit(),
                      table.length(comparison.best_shift_rmse), table.unit()));
}

void add_measured(Table& table, const ComparePlan& plan, const vision::HeapComparison& comparison) {
  const auto& angle = comparison.angle_rad;
  const auto& uncertainty = comparison.uncertainty_rad;
  table.add_row("", "first", "second", "difference");
  table.add_row("angle [°]", angle_cell(angle[0], uncertainty[0]),
                angle_cell(angle[1], uncertainty[1]), difference_cell(comparison.angle));
  table.add_row("  left sides [°]", "", "", difference_cell(comparison.left.angle));
  table.add_row("  right sides [°]", "", "", difference_cell(comparison.right.angle));
  table.add_pair("height", comparison.height);
  table.add_pair("base", comparison.base);
  table.add_pair("  left of the axis", comparison.left.run_out);
  table.add_pair("  right of the axis", comparison.right.run_out);
  add_verdict(table, *comparison.angle, plan.comparing.margin_rad);
  if (!comparison.iou) return;
  table.add_gap();
  add_outlines(table, plan, comparison);
}

void add_warnings(Table& table, const vision::HeapComparison& comparison) {
  if (comparison.status == vision::MeasureStatus::flagged) {
    table.add_line("! ", "A picture is flagged: look at it before you use the verdict.");
  }
  for (const vision::CompareWarning& warning : comparison.warnings) {
    const char* whose = !warning.picture        ? "! "
                        : *warning.picture == 0 ? "! first: "
                                                : "! second: ";
    table.add_line(whose, warning.warning.message);
  }
}

}  // namespace

std::string compare_table(const ComparePlan& plan, const vision::HeapComparison& comparison,
                          int columns) {
  Table table(comparison, columns);
  table.add_line("first   ", plan.pictures[0].string());
  table.add_line("second  ", plan.pictures[1].string());
  if (comparison.status == vision::MeasureStatus::refused) {
    table.add_line("refused: ", comparison.reason);
    return table.text();
  }
  add_measured(table, plan, comparison);
  if (comparison.unit == vision::LengthUnit::root_area) {
    table.add_line("", "Lengths are in % of the square root of a silhouette's area.");
  } else if (comparison.unit == vision::LengthUnit::height) {
    table.add_line("", "Lengths are in % of a heap's height.");
  }
  add_warnings(table, comparison);
  return table.text();
}

}  // namespace repose::cli
