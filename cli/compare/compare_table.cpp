#include "cli/compare/compare_table.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "calibrate/measured/json_text.h"
#include "cli/common/table.h"
#include "dem/experiment/experiment_table.h"
#include "vision/compare/heap_comparison.h"
#include "vision/measure/repose_angle.h"

namespace repose::cli {

namespace {

/// An angle and the half-width of its interval, in degrees, as shown in tables.
std::string angle_cell(const std::optional<double>& angle_rad,
                       const std::optional<double>& uncertainty_rad) {
  if (!angle_rad) return kMissing;
  if (!uncertainty_rad) return fmt::format("{:.2f}", to_degrees(*angle_rad));
  return fmt::format("{:.2f} ± {:.2f}", to_degrees(*angle_rad), to_degrees(*uncertainty_rad));
}

std::string difference_cell(const std::optional<vision::AngleDifference>& angle) {
  if (!angle) return kMissing;
  return angle_cell(angle->difference_rad, (angle->interval_rad[1] - angle->interval_rad[0]) / 2);
}

using Angle = std::optional<double>;
using Cells = std::array<Angle, 2>;

/// Lengths as shown: in mm, or in % without a scale.
class Lengths {
 public:
  explicit Lengths(vision::LengthUnit unit) : is_metric_(unit == vision::LengthUnit::metre) {}

  std::string cell(const Angle& length) const {
    if (!length) return kMissing;
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

/// The definition of the angles, unless it is the default.
void add_definition(Table& table, const calibrate::SetsPlan& plan) {
  const std::string definition = plan.measuring.front().definition_text();
  if (!definition.empty()) table.add_note("", "all angles by " + definition);
}

/// A name and three columns of numbers, with the same widths in all tables of the comparison.
Table comparison_table(const std::array<const char*, 4>& headings) {
  constexpr std::size_t kNameWidth = 24, kCellWidth = 14;
  std::vector<Column> columns = {{.heading = headings[0], .min_width = kNameWidth}};
  for (const std::size_t i : {1, 2, 3}) {
    columns.push_back({.heading = headings[i], .align = Align::right, .min_width = kCellWidth});
  }
  return Table(std::move(columns));
}

std::string fraction(const Angle& cell) { return cell ? fmt::format("{:.3f}", *cell) : kMissing; }

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
  add_definition(table, plan);
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

namespace {

std::string verdict_text(const vision::SetComparison& comparison, double margin_rad) {
  const double margin = to_degrees(margin_rad);
  if (!comparison.angle)
    return "cannot tell: that needs two heaps with an angle in one of the sets.";
  switch (comparison.angle->verdict) {
    case vision::Agreement::equivalent:
      return fmt::format("equivalent: the means differ by less than {:g}°", margin);
    case vision::Agreement::different:
      return fmt::format("different: the interval excludes 0 and is not within ±{:g}°", margin);
    case vision::Agreement::cannot_tell:
      break;
  }
  std::string text =
      fmt::format("cannot tell: the interval includes 0, but also more than {:g}°.", margin);
  if (comparison.heaps_to_tell) {
    text += fmt::format(" If the difference stays as it is, {} heaps in each set would decide.",
                        *comparison.heaps_to_tell);
  }
  return text;
}

Table means_table(const calibrate::SetsPlan& plan, const vision::SetComparison& comparison) {
  const auto& [first, second] = comparison.sets;
  const auto count = [](const vision::SetOfHeaps& set) {
    return fmt::format("{} of {}", set.counted, set.angle_rad.size());
  };
  Table table({{.heading = ""},
               number_column("first"),
               number_column("second"),
               number_column("first - second")});
  table.add_row({"heaps with an angle", count(first), count(second)});
  table.add_row({"mean angle [°]", angle_cell(first.mean_rad, first.uncertainty_rad),
                 angle_cell(second.mean_rad, second.uncertainty_rad),
                 difference_cell(comparison.angle)});
  table.add_row({"heaps' standard deviation [°]", angle_cell(first.sd_rad, {}),
                 angle_cell(second.sd_rad, {})});
  add_definition(table, plan);
  table.add_note("", verdict_text(comparison, plan.comparing.margin_rad));
  return table;
}

std::string outlines_text(const vision::SetComparison& comparison,
                          const std::optional<double>& grain_m) {
  const bool is_metric = comparison.unit == vision::LengthUnit::metre;
  const auto length = [&](double value) {
    return is_metric
               ? fmt::format("{:.2f} mm", value * 1000)
               : fmt::format("{:.2f} % of the square root of a silhouette's area", value * 100);
  };
  std::string text = fmt::format(
      "Mean outlines: overlap (IoU) {:.3f}; their heights differ by {} (root mean "
      "square)",
      *comparison.iou, length(*comparison.profile_rmse));
  if (comparison.profile_mean) text += fmt::format(", {} (mean)", length(*comparison.profile_mean));
  if (grain_m && is_metric) {
    text += fmt::format(", {:.2f} grains", *comparison.profile_rmse / *grain_m);
  }
  return text + '.';
}

/// Each bench picture that gave no angle, and why.
void add_refused(const HeapSource& source, const std::vector<vision::SeenHeap>& heaps, Page& page) {
  if (source.kind == HeapSource::Kind::simulated) return;
  const auto has_angle = [](const vision::ReposeAngle& view) { return view.angle_rad.has_value(); };
  for (std::size_t i = 0; i < source.files.size(); ++i) {
    const std::vector<std::filesystem::path> files = source.files_of_heap(i);
    if (source.is_drawn() && std::ranges::any_of(heaps[i].views, has_angle)) continue;
    for (std::size_t k = 0; k < files.size(); ++k) {
      const vision::ReposeAngle& view = heaps[i].views[k];
      if (view.status != vision::MeasureStatus::refused) continue;
      page.add("! ", fmt::format("{}: {}", files[k].string(), view.reason));
    }
  }
}

}  // namespace

namespace {

std::string distance_text(const std::optional<dem::LevelCamera>& camera) {
  if (!camera) return "";
  return fmt::format(", from {:g} mm away and {:g} mm up", 1000 * camera->distance_m,
                     1000 * camera->height_m);
}

/// "a picture of each heap", "9 pictures of 3 heaps".
std::string pictures_text(const HeapSource& source) {
  std::size_t pictures = 0;
  for (const auto& files : source.views) pictures += files.size();
  if (pictures <= source.files.size()) return "a picture of each heap";
  return fmt::format("{} pictures of {} heaps", pictures, source.files.size());
}

}  // namespace

std::string sets_table(const calibrate::ComparedSets& compared,
                       const std::optional<double>& grain_m, int columns) {
  const calibrate::SetsPlan& plan = compared.plan;
  const auto& heaps = compared.heaps;
  const vision::SetComparison& comparison = compared.comparison;
  Page page(columns);
  constexpr std::array kMarks = {"first   ", "second  "};
  for (const std::size_t i : {0, 1}) {
    const HeapSource& source = plan.sources[i];
    page.add(kMarks[i], source.is_drawn()
                            ? fmt::format("{}: {} heaps, {} views of each{}", source.name,
                                          name_of(source.kind), heaps[i].front().views.size(),
                                          distance_text(plan.camera))
                            : fmt::format("{}: {}", source.name, pictures_text(source)));
  }
  page.add(means_table(plan, comparison));
  if (comparison.iou) {
    page.add_gap();
    page.add(outlines_text(comparison, grain_m));
  }
  for (const std::size_t i : {0, 1}) add_refused(plan.sources[i], heaps[i], page);
  for (const vision::Warning& warning : comparison.warnings) page.add("! ", warning.message);
  return page.text();
}

}  // namespace repose::cli
