#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/compared/compared_sets.h"
#include "cli/common/command.h"
#include "cli/compare/compare.h"
#include "vision/compare/heap_comparison.h"

namespace repose::cli {

/// The option that excludes boxes in each picture.
inline constexpr std::array kExcludeOptions = {"--exclude-first", "--exclude-second"};
/// Maps the fields named in a measurement's advice to each side's options.
inline constexpr std::array<std::array<base::FieldName, 2>, 2> kCompareFields{
    {{{{"excluded box", kExcludeOptions[0]}, {"camera pitch", "--pitch-deg"}}},
     {{{"excluded box", kExcludeOptions[1]}, {"camera pitch", "--pitch-deg"}}}}};

using calibrate::HeapSource;

/// A `repose compare` that can be carried out.
struct ComparePlan : calibrate::SetsPlan {
  std::optional<double> grain_m;
  std::string overlay_file;
  std::string json_file;

  std::vector<std::string> errors;  ///< empty: it can be carried out

  /// Whether two pictures or scans are compared directly; everything else is compared as sets of
  /// heaps.
  bool is_pair() const {
    const auto is_one = [](const HeapSource& source) {
      return source.is_file && source.kind != HeapSource::Kind::simulated;
    };
    return is_one(sources[0]) && is_one(sources[1]);
  }
};

/// Reads and checks all arguments, and whether the output can be written. Reports all errors at
/// once.
ComparePlan plan_compare(const CompareArguments& arguments);

Command compare_command();

}  // namespace repose::cli
