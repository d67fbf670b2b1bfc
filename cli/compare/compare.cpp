#include "cli/compare/compare.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "base/distributions.h"
#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/experiment/heap_angle.h"
#include "calibrate/experiment/scan_angle.h"
#include "calibrate/particles/positions_angle.h"
#include "calibrate/statistics/summary.h"
#include "cli/common/output.h"
#include "cli/common/picture_list.h"
#include "cli/common/terminal.h"
#include "cli/compare/compare_json.h"
#include "cli/compare/compare_options.h"
#include "cli/compare/compare_table.h"
#include "vision/drawing/heap_comparison_overlay.h"
#include "vision/drawing/heap_sets_figure.h"
#include "vision/files/file_list.h"
#include "vision/files/heap_file.h"
#include "vision/scan/scan_file.h"

namespace repose::cli {

namespace {

using vision::SeenHeap;

/// One picture to be measured, and where its result belongs.
struct Task {
  std::size_t set = 0;
  std::size_t heap = 0;
  std::size_t view = 0;
  const calibrate::HeapViewSession* session = nullptr;  ///< of a simulated heap
};

/// Both sets while they are measured.
struct Work {
  std::array<std::vector<SeenHeap>, 2> sets;
  std::vector<std::unique_ptr<calibrate::HeapViewSession>> sessions;
  std::vector<Task> tasks;
  std::array<std::vector<std::string>, 2> pixels;  ///< of each photograph
  std::vector<std::string> errors;
};

/// Pictures, or scans, whose views are drawn when they are read.
void add_files(const ComparePlan& plan, std::size_t set, Work& work) {
  const std::optional<vision::PictureScale>& scale = plan.comparing.scale[set];
  for (std::size_t heap = 0; heap < plan.sources[set].files.size(); ++heap) {
    SeenHeap seen{.views = std::vector<vision::ReposeAngle>(1), .m_per_px = {}};
    if (scale) seen.m_per_px = scale->length_m;
    work.sets[set].push_back(std::move(seen));
    work.pixels[set].emplace_back();
    work.tasks.push_back({.set = set, .heap = heap});
  }
}

void add_simulated(const ComparePlan& plan, std::size_t set, Work& work) {
  const std::vector<std::filesystem::path>& files = plan.sources[set].files;
  for (std::size_t heap = 0; heap < files.size(); ++heap) {
    try {
      work.sessions.push_back(std::make_unique<calibrate::HeapViewSession>(
          calibrate::read_positions(files[heap], {}).heap.scene,
          calibrate::HeapViewing{.camera = plan.camera}));
    } catch (const base::InputError& error) {
      work.errors.push_back(base::naming_file(files[heap].string(), error.what()));
      continue;
    }
    const calibrate::HeapViewSession& session = *work.sessions.back();
    const auto views = static_cast<std::size_t>(session.views());
    work.sets[set].push_back(
        {.views = std::vector<vision::ReposeAngle>(views), .m_per_px = session.m_per_px()});
    for (std::size_t view = 0; view < views; ++view) {
      work.tasks.push_back({.set = set, .heap = heap, .view = view, .session = &session});
    }
  }
}

/// A view of a simulated heap, all views of a scan, or a photograph; of that with a saved scale the
/// scale, too.
void measure(const ComparePlan& plan, const Task& task, render::Renderer* renderer, SeenHeap& seen,
             Work& work) {
  const vision::MeasureOptions& options = plan.measuring[task.set];
  if (task.session != nullptr) {
    seen.views[task.view] =
        task.session->take(*renderer, static_cast<int>(task.view), options).angle;
    return;
  }
  const HeapSource& source = plan.sources[task.set];
  const std::filesystem::path& file = source.files[task.heap];
  if (source.kind == HeapSource::Kind::scans) {
    calibrate::ScanViews scan = calibrate::measure_scan_file(file, options);
    seen = {.views = std::move(scan.views), .m_per_px = scan.m_per_px};
    return;
  }
  vision::HeapInFile measured =
      vision::measure_heap_file(file, {.measuring = options, .scale = {}});
  work.pixels[task.set][task.heap] = vision::pixels_of(measured.picture);
  const std::optional<vision::Estimate>& mm_per_px = measured.heap.sizes.mm_per_px;
  if (!seen.m_per_px && mm_per_px) seen.m_per_px = mm_per_px->value / 1000;
  seen.views.front() = std::move(measured.heap.angle);
}

void measure_all(const ComparePlan& plan, const std::atomic<bool>& is_interrupted, Work& work) {
  Progress progress(work.tasks.size());
  // Contexts are costly to make, and each belongs to one thread.
  tbb::enumerable_thread_specific<std::unique_ptr<render::Renderer>> renderers;
  std::vector<std::string> errors(work.tasks.size());
  tbb::parallel_for(std::size_t{0}, work.tasks.size(), [&](std::size_t i) {
    if (is_interrupted) return;
    const Task& task = work.tasks[i];
    try {
      std::unique_ptr<render::Renderer>& renderer = renderers.local();
      if (task.session != nullptr && !renderer) renderer = std::make_unique<render::Renderer>();
      measure(plan, task, renderer.get(), work.sets[task.set][task.heap], work);
    } catch (const base::InputError& error) {
      errors[i] = base::naming_file(plan.sources[task.set].files[task.heap].string(),
                                    base::text_of(error.faults(), kCompareFields[task.set]));
    }
    progress.advance();
  });
  for (std::string& error : errors) {
    if (!error.empty()) work.errors.push_back(std::move(error));
  }
}

/// Takes copies out of each set, and says how many heaps are in both.
void drop_copies(ComparePlan& plan, Work& work) {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> pixels;
  for (const std::size_t set : {0, 1}) {
    const auto& own = plan.sources[set].files;
    files.insert(files.end(), own.begin(), own.end());
    work.pixels[set].resize(own.size());
    pixels.insert(pixels.end(), work.pixels[set].begin(), work.pixels[set].end());
  }
  const std::size_t first_size = plan.sources[0].files.size();
  const auto first_of = vision::copies_among(files, pixels);
  std::array<std::vector<std::filesystem::path>, 2> kept;
  std::array<std::vector<SeenHeap>, 2> heaps;
  std::set<std::size_t> in_second;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::size_t set = i < first_size ? 0 : 1;
    const std::size_t same = first_of[i].value_or(i);
    const bool is_repeated = set == 0 ? same != i : !in_second.insert(same).second;
    if (is_repeated) {
      print_line(vision::text_of_copy(files[i], files[same]));
      continue;
    }
    if (set == 1 && same < first_size) ++plan.in_both;
    kept[set].push_back(files[i]);
    heaps[set].push_back(std::move(work.sets[set][i - (set == 0 ? 0 : first_size)]));
  }
  for (const std::size_t set : {0, 1}) {
    plan.sources[set].files = std::move(kept[set]);
    work.sets[set] = std::move(heaps[set]);
  }
}

/// Heaps that have one scale in all their pictures; none where they have several.
std::optional<double> scale_of_both(const SeenHeap& one, const SeenHeap& other) {
  constexpr double kAlike = 1e-3;
  if (!one.m_per_px || !other.m_per_px) return std::nullopt;
  return std::abs(*one.m_per_px / *other.m_per_px - 1) < kAlike ? one.m_per_px : std::nullopt;
}

/// Photographs of one heap become its views: a heap's angle is the mean of them.
void group_by_name(ComparePlan& plan, Work& work) {
  if (!plan.groups_by_name) return;
  for (const std::size_t set : {0, 1}) {
    HeapSource& source = plan.sources[set];
    if (source.is_drawn()) continue;
    std::vector<std::filesystem::path> firsts;
    std::vector<SeenHeap> heaps;
    for (std::size_t i = 0; i < source.files.size(); ++i) {
      const std::string name = vision::heap_by_name(source.files[i]);
      const auto same = std::ranges::find(firsts, name, vision::heap_by_name);
      SeenHeap& seen = work.sets[set][i];
      if (same == firsts.end()) {
        firsts.push_back(source.files[i]);
        source.views.push_back({source.files[i]});
        heaps.push_back(std::move(seen));
        continue;
      }
      const auto heap = static_cast<std::size_t>(same - firsts.begin());
      source.views[heap].push_back(source.files[i]);
      heaps[heap].m_per_px = scale_of_both(heaps[heap], seen);
      heaps[heap].views.push_back(std::move(seen.views.front()));
    }
    source.files = std::move(firsts);
    work.sets[set] = std::move(heaps);
  }
}

/// A set agrees with itself, whatever its grains are.
void warn_of_both(const ComparePlan& plan, vision::SetComparison& comparison) {
  if (plan.in_both == 0) return;
  const auto& [first, second] = plan.sources;
  const auto size = [](const HeapSource& source) { return static_cast<int>(source.files.size()); };
  const bool is_all = plan.in_both == size(first) && plan.in_both == size(second);
  comparison.warnings.push_back(
      {"same_heaps",
       is_all ? "Both sets are the same heaps: a set is compared with itself, and that they agree "
                "says nothing."
              : fmt::format("{} of the heaps {} in both sets: that they agree says less.",
                            plan.in_both, plan.in_both == 1 ? "is" : "are")});
}

void write_figure(const ComparePlan& plan, const vision::SetComparison& comparison) {
  if (plan.overlay_file.empty()) return;
  vision::HeapSetsNotes notes{.titles = {}, .margin_rad = plan.comparing.margin_rad};
  for (const std::size_t i : {0, 1}) notes.titles[i] = title_of(plan.sources[i]);
  vision::write_picture(plan.overlay_file, vision::draw_heap_sets(comparison, notes));
}

/// Carries out `repose compare` where one of both is more than one picture.
ExitCode compare_sets(ComparePlan plan, const std::atomic<bool>& is_interrupted) {
  Work work;
  for (const std::size_t set : {0, 1}) {
    if (plan.sources[set].kind == HeapSource::Kind::simulated) {
      add_simulated(plan, set, work);
    } else {
      add_files(plan, set, work);
    }
  }
  if (work.errors.empty()) measure_all(plan, is_interrupted, work);
  if (is_interrupted) {
    print_line("interrupted, no results were written");
    return ExitCode::interrupted;
  }
  print_lines(work.errors);
  if (!work.errors.empty()) return ExitCode::bad_input;

  drop_copies(plan, work);
  group_by_name(plan, work);
  vision::SetComparison comparison =
      vision::compare_sets(work.sets[0], work.sets[1], plan.comparing.margin_rad);
  warn_of_both(plan, comparison);
  const bool is_refused = !comparison.sets[0].mean_rad || !comparison.sets[1].mean_rad;
  if (is_refused && !comparison.iou && !plan.overlay_file.empty()) {
    print_line(plan.overlay_file + ": not drawn, as there is nothing to compare");
  } else {
    write_figure(plan, comparison);
  }
  Outputs outputs;
  outputs.add(plan.json_file, sets_json(plan, work.sets, comparison));
  outputs.show(sets_table(plan, work.sets, comparison, columns_of(stdout)));
  outputs.write();
  return is_refused ? ExitCode::nothing_measurable : ExitCode::done;
}

struct MeasuredHeap {
  vision::Picture picture;
  vision::MeasureOptions used;  ///< with the picture's own hints
  vision::ReposeAngle angle;
  std::optional<double> m_per_px;           ///< by a saved scale, or a scan's
  std::optional<double> between_views_rad;  ///< standard deviation; only of a scan
  std::string error;
};

/// Half-width of the interval that holds 95 % of the flanks in all views: nobody knows which side
/// of a scanned heap is which of another.
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

/// The view of a scan that is nearest to the mean stands for it; the angle is the mean of all.
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

/// A photograph shows one side of a heap, and a scan's angle is the mean over all sides: how much
/// they scatter is between the two.
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
  return compare_sets(std::move(plan), is_interrupted);
}

}  // namespace repose::cli
