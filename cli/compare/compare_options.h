#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/experiment/heap_angle.h"
#include "cli/compare/compare.h"
#include "cli/compare/heap_source.h"
#include "vision/compare/heap_comparison.h"

namespace repose::cli {

/// The option with which each picture's boxes are left out.
inline constexpr std::array kExcludeOptions = {"--exclude-first", "--exclude-second"};
/// The options of each side by the fields that a measurement advises to give.
inline constexpr std::array<std::array<base::FieldName, 2>, 2> kCompareFields{
    {{{{"excluded box", kExcludeOptions[0]}, {"camera pitch", "--pitch-deg"}}},
     {{{"excluded box", kExcludeOptions[1]}, {"camera pitch", "--pitch-deg"}}}}};

/// A `repose compare` that can be carried out.
struct ComparePlan {
  std::array<HeapSource, 2> sources;
  std::array<vision::MeasureOptions, 2> measuring;
  vision::CompareOptions comparing;
  std::optional<double> grain_m;
  std::optional<calibrate::HeapCamera> camera;  ///< before simulated heaps; none: far away
  bool groups_by_name = false;  ///< pictures that differ in a last number alone are of one heap
  int in_both = 0;              ///< heaps that are in both sets, found when they are read
  std::string overlay_file;
  std::string json_file;

  std::vector<std::string> errors;  ///< empty: it can be carried out

  /// Two pictures are compared with each other; all else as sets of heaps.
  bool is_pair() const { return sources[0].is_one_picture() && sources[1].is_one_picture(); }
};

/// Reads and checks all that was typed, also whether the output can be written. All errors at once.
ComparePlan plan_compare(const CompareArguments& arguments);

}  // namespace repose::cli
