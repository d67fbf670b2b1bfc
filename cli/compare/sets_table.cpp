#include "cli/compare/sets_table.h"

#include <fmt/format.h>

#include "cli/common/degrees.h"
#include "cli/common/page.h"
#include "cli/compare/angle_cells.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
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

Table means_table(const ComparePlan& plan, const vision::SetComparison& comparison) {
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
  table.add_note("", verdict_text(comparison, plan.comparing.margin_rad));
  return table;
}

std::string outlines_text(const ComparePlan& plan, const vision::SetComparison& comparison) {
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
  if (plan.grain_m && is_metric) {
    text += fmt::format(", {:.2f} grains", *comparison.profile_rmse / *plan.grain_m);
  }
  return text + '.';
}

/// Each picture of a bench that gave no angle, and why.
void add_refused(const HeapSource& source, const std::vector<vision::SeenHeap>& heaps, Page& page) {
  for (std::size_t i = 0; i < source.pictures.size(); ++i) {
    const std::vector<std::filesystem::path> files = source.files_of_heap(i);
    for (std::size_t k = 0; k < files.size(); ++k) {
      const vision::ReposeAngle& view = heaps[i].views[k];
      if (view.status != vision::MeasureStatus::refused) continue;
      page.add("! ", fmt::format("{}: {}", files[k].string(), view.reason));
    }
  }
}

}  // namespace

std::string title_of(const HeapSource& source) {
  const std::filesystem::path path(source.name);
  const std::filesystem::path name =
      path.has_filename() ? path.filename() : path.parent_path().filename();
  return fmt::format("{} ({})", name.string(), source.states.empty() ? "pictures" : "simulated");
}

namespace {

std::string distance_text(const std::optional<calibrate::HeapCamera>& camera) {
  if (!camera) return "";
  return fmt::format(", from {:g} mm away and {:g} mm up", 1000 * camera->distance_m,
                     1000 * camera->height_m);
}

/// "a picture of each heap", "9 pictures of 3 heaps".
std::string pictures_text(const HeapSource& source) {
  std::size_t pictures = 0;
  for (const auto& files : source.views) pictures += files.size();
  if (pictures <= source.pictures.size()) return "a picture of each heap";
  return fmt::format("{} pictures of {} heaps", pictures, source.pictures.size());
}

}  // namespace

std::string sets_table(const ComparePlan& plan,
                       const std::array<std::vector<vision::SeenHeap>, 2>& heaps,
                       const vision::SetComparison& comparison, int columns) {
  Page page(columns);
  constexpr std::array kMarks = {"first   ", "second  "};
  for (const std::size_t i : {0, 1}) {
    const HeapSource& source = plan.sources[i];
    page.add(kMarks[i],
             source.states.empty()
                 ? fmt::format("{}: {}", source.name, pictures_text(source))
                 : fmt::format("{}: simulated heaps, {} views of each{}", source.name,
                               heaps[i].front().views.size(), distance_text(plan.camera)));
  }
  page.add(means_table(plan, comparison));
  if (comparison.iou) {
    page.add_gap();
    page.add(outlines_text(plan, comparison));
  }
  for (const std::size_t i : {0, 1}) add_refused(plan.sources[i], heaps[i], page);
  for (const vision::Warning& warning : comparison.warnings) page.add("! ", warning.message);
  return page.text();
}

}  // namespace repose::cli
