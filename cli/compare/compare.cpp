#include "cli/compare/compare.h"

#include <algorithm>
#include <array>
#include <utility>

#include <tbb/parallel_for.h>

#include "base/input_error.h"
#include "cli/common/interrupt.h"
#include "cli/common/output.h"
#include "cli/common/picture_list.h"
#include "cli/common/terminal.h"
#include "cli/compare/compare_json.h"
#include "cli/compare/compare_options.h"
#include "cli/compare/compare_sets.h"
#include "cli/compare/compare_table.h"
#include "vision/drawing/heap_comparison_overlay.h"
#include "vision/hints/hint_file.h"

namespace repose::cli {
namespace {

struct MeasuredHeap {
  vision::Picture picture;
  vision::MeasureOptions used;  ///< with the picture's own hints
  vision::ReposeAngle angle;
  std::optional<double> m_per_px;  ///< by a saved scale
  std::string error;
};

MeasuredHeap measured(const std::filesystem::path& file, const vision::MeasureOptions& options) {
  MeasuredHeap heap;
  heap.picture = vision::read_picture(file);
  const vision::PictureSettings told =
      vision::with_saved_hints({.measuring = options, .scale = {}}, file);
  vision::SizedHeap sized = vision::measure_sized_heap(heap.picture, told.measuring, told.scale);
  if (!sized.corrected.empty()) heap.picture = std::move(sized.corrected);
  heap.used = told.measuring;
  heap.angle = std::move(sized.angle);
  if (sized.sizes.mm_per_px) heap.m_per_px = sized.sizes.mm_per_px->value / 1000;
  return heap;
}

std::array<MeasuredHeap, 2> measure_both(const ComparePlan& plan) {
  std::array<MeasuredHeap, 2> heaps;
  tbb::parallel_for(std::size_t{0}, heaps.size(), [&](std::size_t i) {
    try {
      heaps[i] = measured(plan.sources[i].pictures.front(), plan.measuring[i]);
    } catch (const base::InputError& error) {
      heaps[i].error =
          naming_file(plan.sources[i].name, base::text_of(error.faults(), kCompareFields[i]));
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

/// Where the command gave none.
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
      .titles = {plan.sources[0].pictures.front().filename().string(),
                 plan.sources[1].pictures.front().filename().string()},
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
  const std::array<MeasuredHeap, 2> heaps = measure_both(plan);
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
  return compare_sets(std::move(plan), is_interrupted);
}

}  // namespace repose::cli
