#include "cli/compare/compare.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "base/distributions.h"
#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/compared/compared_json.h"
#include "calibrate/compared/compared_sets.h"
#include "calibrate/experiment/heap_angle.h"
#include "calibrate/experiment/scan_angle.h"
#include "calibrate/statistics/summary.h"
#include "cli/common/output.h"
#include "cli/common/picture_list.h"
#include "cli/common/terminal.h"
#include "cli/compare/compare_json.h"
#include "cli/compare/compare_options.h"
#include "cli/compare/compare_table.h"
#include "vision/drawing/heap_comparison_overlay.h"
#include "vision/files/heap_file.h"
#include "vision/scan/scan_file.h"

namespace repose::cli {

namespace {

/// Runs `repose compare` if either side has more than one picture.
ExitCode compare_sets(const ComparePlan& plan, const std::atomic<bool>& is_interrupted) {
  std::optional<Progress> bar;
  const calibrate::SetsPlan& sets = plan;
  const calibrate::ComparedSets compared = calibrate::compare_sets_of(
      sets, {.begins = [&](std::size_t pictures) { bar.emplace(pictures); },
             .advances = [&] { bar->advance(); },
             .is_stopped = [&] { return is_interrupted.load(); }});
  bar.reset();
  if (compared.was_stopped) {
    print_line("interrupted, no results were written");
    return ExitCode::interrupted;
  }
  print_lines(compared.errors);
  if (!compared.errors.empty()) return ExitCode::bad_input;
  print_lines(compared.notes);
  if (!plan.overlay_file.empty() && !compared.has_figure()) {
    print_line(plan.overlay_file + ": not drawn, as there is nothing to compare");
  } else if (!plan.overlay_file.empty()) {
    vision::write_picture(plan.overlay_file, calibrate::figure_of(compared));
  }
  Outputs outputs;
  outputs.add(plan.json_file, calibrate::sets_json(compared));
  outputs.show(sets_table(compared, plan.grain_m, columns_of(stdout)));
  outputs.write();
  return compared.has_verdict() ? ExitCode::done : ExitCode::nothing_measurable;
}

struct MeasuredHeap {
  vision::Picture picture;
  vision::MeasureOptions used;  ///< with the picture's own hints
  vision::ReposeAngle angle;
  std::optional<double> m_per_px;           ///< by a saved scale, or a scan's
  std::optional<double> between_views_rad;  ///< standard deviation; only of a scan
  std::string error;
};

/// Half-width of the interval that contains 95 % of the flanks in all views: it is unknown how the
/// sides of two scanned heaps correspond.
double scatter_of_sides(const std::vector<vision::ReposeAngle>& views) {
  std::vector<double> sides_rad;
  for (const vision::ReposeAngle& view : views) {
    for (const vision::Flank* side : {&view.left, &view.right}) {
      if (side->angle_rad) sides_rad.push_back(*side->angle_rad);
    }
  }
  if (sides_rad.size() < 2) return 0;
  const calibrate::Summary sides = calibrate::summarise(sides_rad);
  return base::student_t_quantile(.975, sides.n - 1) * sides.sd.value_or(0);
}

/// A scan is represented by the view nearest to the mean; the angle is the mean of all.
MeasuredHeap measured_scan(const std::filesystem::path& file,
                           const vision::MeasureOptions& options) {
  calibrate::ScanViews seen = calibrate::measure_scan_file(file, options);
  MeasuredHeap heap{.picture = std::move(seen.typical_picture),
                    .used = options,
                    .angle = std::move(seen.angle),
                    .m_per_px = seen.m_per_px,
                    .between_views_rad = seen.between_views_rad,
                    .error = {}};
  if (!heap.angle.angle_rad) return heap;
  const double sides_rad = scatter_of_sides(seen.views);
  vision::ReposeAngle mean = std::move(heap.angle);
  heap.angle = std::move(seen.views[seen.typical]);
  heap.angle.status = mean.status;
  heap.angle.angle_rad = mean.angle_rad;
  heap.angle.uncertainty_rad = mean.uncertainty_rad;
  heap.angle.own_uncertainty_rad = mean.own_uncertainty_rad;
  heap.angle.warnings = std::move(mean.warnings);
  for (vision::Flank* side : {&heap.angle.left, &heap.angle.right}) {
    if (!side->uncertainty_rad) continue;
    side->uncertainty_rad =
        std::hypot(*side->uncertainty_rad, sides_rad, mean.uncertainty_rad.value_or(0));
  }
  return heap;
}

MeasuredHeap measured(const std::filesystem::path& file, const vision::MeasureOptions& options) {
  if (vision::has_scan_ending(file)) return measured_scan(file, options);
  vision::HeapInFile seen = vision::measure_heap_file(file, {.measuring = options, .scale = {}});
  MeasuredHeap heap{.picture = seen.measured(),
                    .used = std::move(seen.told.measuring),
                    .angle = std::move(seen.heap.angle),
                    .m_per_px = {},
                    .between_views_rad = {},
                    .error = {}};
  const std::optional<vision::Estimate>& scale = seen.heap.sizes.mm_per_px;
  if (scale) heap.m_per_px = scale->value / 1000;
  return heap;
}

std::array<MeasuredHeap, 2> measure_both(const ComparePlan& plan) {
  std::array<MeasuredHeap, 2> heaps;
  tbb::parallel_for(std::size_t{0}, heaps.size(), [&](std::size_t i) {
    try {
      heaps[i] = measured(plan.sources[i].files.front(), plan.measuring[i]);
    } catch (const base::InputError& error) {
      heaps[i].error =
          base::naming_file(plan.sources[i].name, base::text_of(error.faults(), kCompareFields[i]));
    }
  });
  return heaps;
}

bool is_same_measurement(const std::array<MeasuredHeap, 2>& heaps) {
  const vision::MeasureOptions& a = heaps[0].used;
  const vision::MeasureOptions& b = heaps[1].used;
  const auto same_box = [](const vision::Box& p, const vision::Box& q) {
    return p.x == q.x && p.y == q.y && p.width == q.width && p.height == q.height;
  };
  return heaps[0].picture.width == heaps[1].picture.width &&
         heaps[0].picture.bgr == heaps[1].picture.bgr && a.camera_pitch_rad == b.camera_pitch_rad &&
         a.hints.empty() && b.hints.empty() &&
         std::equal(a.excluded.begin(), a.excluded.end(), b.excluded.begin(), b.excluded.end(),
                    same_box);
}

/// A photograph shows one side of a heap, while a scan's angle is the mean over all sides: the
/// scatter of the sides is an uncertainty of their difference.
void add_views_scatter(std::array<MeasuredHeap, 2>& heaps) {
  const bool is_mixed =
      heaps[0].between_views_rad.has_value() != heaps[1].between_views_rad.has_value();
  if (!is_mixed) return;
  for (MeasuredHeap& heap : heaps) {
    if (!heap.between_views_rad || !heap.angle.uncertainty_rad) continue;
    const double scatter_rad =
        base::student_t_quantile(.975, calibrate::kHeapViews - 1) * *heap.between_views_rad;
    heap.angle.uncertainty_rad = std::hypot(*heap.angle.uncertainty_rad, scatter_rad);
    heap.angle.warnings.push_back(
        {.code = "views_scatter",
         .message = fmt::format("The photograph shows one side; the scan's angle is the mean of {} "
                                "views all around, which scatter by {:.2f} degrees (sd): ±{:.2f} "
                                "degrees of its interval are for that.",
                                calibrate::kHeapViews, to_degrees(*heap.between_views_rad),
                                to_degrees(scatter_rad))});
  }
}

/// A scan has its own scale, or none.
void take_scan_scales(const std::array<MeasuredHeap, 2>& heaps, ComparePlan& plan) {
  using vision::PictureScale;
  for (const std::size_t i : {0, 1}) {
    if (!heaps[i].between_views_rad || !plan.comparing.scale[i]) continue;
    if (!heaps[i].m_per_px) {
      plan.comparing.scale = {};
      return;
    }
    plan.comparing.scale[i] =
        PictureScale{.from = PictureScale::From::pixel, .length_m = *heaps[i].m_per_px};
  }
}

/// Used if the command gave none.
void take_saved_scales(const std::array<MeasuredHeap, 2>& heaps, ComparePlan& plan) {
  using vision::PictureScale;
  if (plan.comparing.scale[0] || !heaps[0].m_per_px || !heaps[1].m_per_px) return;
  for (const std::size_t i : {0, 1}) {
    plan.comparing.scale[i] =
        PictureScale{.from = PictureScale::From::pixel, .length_m = *heaps[i].m_per_px};
  }
}

void write_overlay(const ComparePlan& plan, const MeasuredHeap& first,
                   const vision::HeapComparison& comparison) {
  if (plan.overlay_file.empty()) return;
  if (comparison.status == vision::MeasureStatus::refused) {
    print_line(plan.overlay_file + ": not drawn, as there is nothing to compare");
    return;
  }
  const vision::ComparisonOverlayNotes notes{
      .titles = {plan.sources[0].files.front().filename().string(),
                 plan.sources[1].files.front().filename().string()},
      .margin_rad = plan.comparing.margin_rad};
  vision::write_picture(plan.overlay_file,
                        vision::draw_comparison(first.picture, first.angle, comparison, notes));
}

void write_results(const ComparePlan& plan, const vision::HeapComparison& comparison) {
  Outputs outputs;
  outputs.add(plan.json_file, compare_json(plan, comparison));
  outputs.show(compare_table(plan, comparison, columns_of(stdout)));
  outputs.write();
}

ExitCode compare_pair(ComparePlan plan, const std::atomic<bool>& is_interrupted) {
  std::array<MeasuredHeap, 2> heaps = measure_both(plan);
  if (is_interrupted) {
    print_line("interrupted, no results were written");
    return ExitCode::interrupted;
  }
  std::vector<std::string> errors;
  for (const MeasuredHeap& heap : heaps) {
    if (!heap.error.empty()) errors.push_back(heap.error);
  }
  print_lines(errors);
  if (!errors.empty()) return ExitCode::bad_input;

  add_views_scatter(heaps);
  take_scan_scales(heaps, plan);
  take_saved_scales(heaps, plan);
  plan.comparing.same_measurement = is_same_measurement(heaps);
  const vision::HeapComparison comparison =
      vision::compare_heaps(heaps[0].angle, heaps[1].angle, plan.comparing);
  write_overlay(plan, heaps[0], comparison);
  write_results(plan, comparison);
  return comparison.status == vision::MeasureStatus::refused ? ExitCode::nothing_measurable
                                                             : ExitCode::done;
}

}  // namespace

ExitCode run_compare(const CompareArguments& arguments) {
  ComparePlan plan = plan_compare(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  const std::atomic<bool>& is_interrupted = watch_for_interrupt();
  if (plan.is_pair()) return compare_pair(std::move(plan), is_interrupted);
  return compare_sets(plan, is_interrupted);
}

}  // namespace repose::cli
