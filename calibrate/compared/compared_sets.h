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

/// Two sets of heap files, measured and compared, for `repose compare` and the studio.
namespace repose::calibrate {

struct SetsPlan {
  std::array<HeapSource, 2> sources = {};
  std::array<vision::MeasureOptions, 2> measuring = {};
  vision::CompareOptions comparing = {};
  std::optional<dem::LevelCamera> camera = {};  ///< for simulated heaps; std::nullopt: far away
  bool groups_by_name =
      false;  ///< pictures whose names differ only in a last number are of one heap
  std::array<base::FieldNames, 2> fields =
      {};  ///< names of the inputs in each set's error messages
};

/// Called by several threads during the work.
struct SetsProgress {
  std::function<void(std::size_t pictures)> begins = [](std::size_t) {};
  std::function<void()> advances = [] {};
  std::function<bool()> is_stopped = [] { return false; };
};

struct ComparedSets {
  SetsPlan plan;  ///< without duplicates; photographs of one heap are its views
  std::array<std::vector<vision::SeenHeap>, 2> heaps;
  vision::SetComparison comparison;
  std::vector<std::string> notes;   ///< on duplicates that were left out
  std::vector<std::string> errors;  ///< of files; if there are any, nothing is compared
  bool was_stopped = false;

  bool has_verdict() const { return comparison.sets[0].mean_rad && comparison.sets[1].mean_rad; }
  /// Whether there is anything to draw.
  bool has_figure() const { return has_verdict() || comparison.iou; }
};

ComparedSets compare_sets_of(SetsPlan plan, const SetsProgress& progress);

/// Both sets, as `repose compare --overlay` draws them.
vision::Picture figure_of(const ComparedSets& compared, int width_px = vision::kSetsFigure_px);

}  // namespace repose::calibrate
