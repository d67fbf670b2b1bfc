#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/compared/heap_source.h"
#include "calibrate/experiment/heap_angle.h"
#include "vision/compare/heap_sets.h"
#include "vision/drawing/heap_sets_figure.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

/// Two sets of files with heaps measured and compared: what `repose compare` prints of sets and the
/// studio shows.
namespace repose::calibrate {

struct SetsPlan {
  std::array<HeapSource, 2> sources = {};
  std::array<vision::MeasureOptions, 2> measuring = {};
  vision::CompareOptions comparing = {};
  std::optional<dem::LevelCamera> camera = {};  ///< before simulated heaps; none: far away
  bool groups_by_name = false;  ///< pictures that differ in a last number alone are of one heap
  std::array<base::FieldNames, 2> fields = {};  ///< what faults of each set call what was said
};

/// Told by several threads while it is worked.
struct SetsProgress {
  std::function<void(std::size_t pictures)> begins = [](std::size_t) {};
  std::function<void()> advances = [] {};
  std::function<bool()> is_stopped = [] { return false; };
};

struct ComparedSets {
  SetsPlan plan;  ///< without copies; photographs of one heap are its views
  std::array<std::vector<vision::SeenHeap>, 2> heaps;
  vision::SetComparison comparison;
  std::vector<std::string> notes;   ///< of copies that were left out
  std::vector<std::string> errors;  ///< of files; nothing is compared where there are some
  bool was_stopped = false;

  bool has_verdict() const { return comparison.sets[0].mean_rad && comparison.sets[1].mean_rad; }
  /// Whether there is anything to draw.
  bool has_figure() const { return has_verdict() || comparison.iou; }
};

ComparedSets compare_sets_of(SetsPlan plan, const SetsProgress& progress);

/// Both, as `repose compare --overlay` draws them.
vision::Picture figure_of(const ComparedSets& compared, int width_px = vision::kSetsFigure_px);

}  // namespace repose::calibrate
