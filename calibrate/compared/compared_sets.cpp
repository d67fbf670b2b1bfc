#include "calibrate/compared/compared_sets.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "calibrate/experiment/scan_angle.h"
#include "calibrate/particles/positions_angle.h"
#include "vision/files/file_list.h"
#include "vision/files/heap_file.h"

namespace repose::calibrate {

namespace {

using vision::SeenHeap;

/// One picture to be measured, and where its result belongs.
struct Task {
  std::size_t set = 0;
  std::size_t heap = 0;
  std::size_t view = 0;
  const HeapViewSession* session = nullptr;  ///< of a simulated heap
};

/// Both sets while being measured.
struct Work {
  std::array<std::vector<SeenHeap>, 2> sets;
  std::vector<std::unique_ptr<HeapViewSession>> sessions;
  std::vector<Task> tasks;
  std::array<std::vector<std::string>, 2> pixels;  ///< of each photograph
  std::vector<std::string> errors;
  std::vector<std::string> notes;
  int in_both = 0;  ///< heaps that are in both sets
};

/// Adds pictures, or scans, whose views are drawn when they are read.
void add_files(const SetsPlan& plan, std::size_t set, Work& work) {
  const std::optional<vision::PictureScale>& scale = plan.comparing.scale[set];
  for (std::size_t heap = 0; heap < plan.sources[set].files.size(); ++heap) {
    SeenHeap seen{.views = std::vector<vision::ReposeAngle>(1), .m_per_px = {}};
    if (scale) seen.m_per_px = scale->length_m;
    work.sets[set].push_back(std::move(seen));
    work.pixels[set].emplace_back();
    work.tasks.push_back({.set = set, .heap = heap});
  }
}

void add_simulated(const SetsPlan& plan, std::size_t set, Work& work) {
  const std::vector<std::filesystem::path>& files = plan.sources[set].files;
  for (std::size_t heap = 0; heap < files.size(); ++heap) {
    try {
      work.sessions.push_back(std::make_unique<HeapViewSession>(
          read_positions(files[heap], {}).heap.scene, HeapViewing{.camera = plan.camera}));
    } catch (const base::InputError& error) {
      work.errors.push_back(base::naming_file(files[heap].string(), error.what()));
      continue;
    }
    const HeapViewSession& session = *work.sessions.back();
    const auto views = static_cast<std::size_t>(session.views());
    work.sets[set].push_back(
        {.views = std::vector<vision::ReposeAngle>(views), .m_per_px = session.m_per_px()});
    for (std::size_t view = 0; view < views; ++view) {
      work.tasks.push_back({.set = set, .heap = heap, .view = view, .session = &session});
    }
  }
}

/// Measures a view of a simulated heap, all views of a scan, or a photograph, including its saved
/// scale if any.
void measure(const SetsPlan& plan, const Task& task, render::Renderer* renderer, SeenHeap& seen,
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
    ScanViews scan = measure_scan_file(file, options);
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

void measure_all(const SetsPlan& plan, const SetsProgress& progress, Work& work) {
  progress.begins(work.tasks.size());
  // Contexts are costly to make, and each belongs to one thread.
  tbb::enumerable_thread_specific<std::unique_ptr<render::Renderer>> renderers;
  std::vector<std::string> errors(work.tasks.size());
  tbb::parallel_for(std::size_t{0}, work.tasks.size(), [&](std::size_t i) {
    if (progress.is_stopped()) return;
    const Task& task = work.tasks[i];
    try {
      std::unique_ptr<render::Renderer>& renderer = renderers.local();
      if (task.session != nullptr && !renderer) renderer = std::make_unique<render::Renderer>();
      measure(plan, task, renderer.get(), work.sets[task.set][task.heap], work);
    } catch (const base::InputError& error) {
      errors[i] = base::naming_file(plan.sources[task.set].files[task.heap].string(),
                                    base::text_of(error.faults(), plan.fields[task.set]));
    }
    progress.advances();
  });
  for (std::string& error : errors) {
    if (!error.empty()) work.errors.push_back(std::move(error));
  }
}

/// Removes duplicates from each set, and counts the heaps that are in both.
void drop_copies(SetsPlan& plan, Work& work) {
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
      work.notes.push_back(vision::text_of_copy(files[i], files[same]));
      continue;
    }
    if (set == 1 && same < first_size) ++work.in_both;
    kept[set].push_back(files[i]);
    heaps[set].push_back(std::move(work.sets[set][i - (set == 0 ? 0 : first_size)]));
  }
  for (const std::size_t set : {0, 1}) {
    plan.sources[set].files = std::move(kept[set]);
    work.sets[set] = std::move(heaps[set]);
  }
}

/// The common scale of a heap's pictures; std::nullopt if they differ.
std::optional<double> scale_of_both(const SeenHeap& one, const SeenHeap& other) {
  constexpr double kAlike = 1e-3;
  if (!one.m_per_px || !other.m_per_px) return std::nullopt;
  return std::abs(*one.m_per_px / *other.m_per_px - 1) < kAlike ? one.m_per_px : std::nullopt;
}

/// Photographs of one heap become its views: the heap's angle is their mean.
void group_by_name(SetsPlan& plan, Work& work) {
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

/// Warns about heaps in both sets: a set agrees with itself, whatever its grains are.
void warn_of_both(const SetsPlan& plan, int in_both, vision::SetComparison& comparison) {
  if (in_both == 0) return;
  const auto& [first, second] = plan.sources;
  const auto size = [](const HeapSource& source) { return static_cast<int>(source.files.size()); };
  const bool is_all = in_both == size(first) && in_both == size(second);
  comparison.warnings.push_back(
      {"same_heaps",
       is_all ? "Both sets are the same heaps: a set is compared with itself, and that they agree "
                "says nothing."
              : fmt::format("{} of the heaps {} in both sets: that they agree says less.", in_both,
                            in_both == 1 ? "is" : "are")});
}

}  // namespace

ComparedSets compare_sets_of(SetsPlan plan, const SetsProgress& progress) {
  Work work;
  for (const std::size_t set : {0, 1}) {
    if (plan.sources[set].kind == HeapSource::Kind::simulated) {
      add_simulated(plan, set, work);
    } else {
      add_files(plan, set, work);
    }
  }
  if (work.errors.empty()) measure_all(plan, progress, work);
  ComparedSets compared;
  compared.was_stopped = progress.is_stopped();
  compared.errors = std::move(work.errors);
  if (compared.was_stopped || !compared.errors.empty()) return compared;
  drop_copies(plan, work);
  group_by_name(plan, work);
  compared.comparison = vision::compare_sets(work.sets[0], work.sets[1], plan.comparing.margin_rad);
  warn_of_both(plan, work.in_both, compared.comparison);
  compared.notes = std::move(work.notes);
  compared.heaps = std::move(work.sets);
  compared.plan = std::move(plan);
  return compared;
}

vision::Picture figure_of(const ComparedSets& compared, int width_px) {
  vision::HeapSetsNotes notes{
      .titles = {}, .margin_rad = compared.plan.comparing.margin_rad, .width_px = width_px};
  for (const std::size_t i : {0, 1}) notes.titles[i] = title_of(compared.plan.sources[i]);
  return vision::draw_heap_sets(compared.comparison, notes);
}

}  // namespace repose::calibrate
