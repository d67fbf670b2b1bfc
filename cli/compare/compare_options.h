#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/experiment/heap_angle.h"
#include "cli/common/command.h"
#include "cli/compare/compare.h"
#include "dem/experiment/experiment_table.h"
#include "vision/compare/heap_comparison.h"

namespace repose::cli {

/// What a name on the command line stands for: one heap, or those of a folder.
struct HeapSource {
  enum class Kind {
    pictures,
    simulated,  ///< states of repose, or particles of another program
    scans,
  };
  std::string name;
  Kind kind = Kind::pictures;
  std::vector<std::filesystem::path> files;  ///< of a heap each
  /// Of each of the pictures, once they stand for a heap with several, all that are of it.
  std::vector<std::vector<std::filesystem::path>> views = {};
  bool is_file = true;  ///< not a folder

  /// Files of the heap in that place.
  std::vector<std::filesystem::path> files_of_heap(std::size_t heap) const {
    return views.empty() ? std::vector{files[heap]} : views[heap];
  }
  /// Their views are drawn here, from all around.
  bool is_drawn() const { return kind != Kind::pictures; }
};

/// A folder stands for the pictures in it; else for the scans; else for the heaps of its subfolder
/// `heaps`, as `repose calibrate` leaves them, or for those in itself, as `repose simulate heap`
/// does. All errors are added.
std::array<HeapSource, 2> heap_sources(const std::vector<std::string>& names,
                                       std::vector<std::string>& errors);

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
  std::optional<dem::LevelCamera> camera;  ///< before simulated heaps; none: far away
  bool groups_by_name = false;  ///< pictures that differ in a last number alone are of one heap
  int in_both = 0;              ///< heaps that are in both sets, found when they are read
  std::string overlay_file;
  std::string json_file;

  std::vector<std::string> errors;  ///< empty: it can be carried out

  /// Two pictures or scans are compared with each other; all else as sets of heaps.
  bool is_pair() const {
    const auto is_one = [](const HeapSource& source) {
      return source.is_file && source.kind != HeapSource::Kind::simulated;
    };
    return is_one(sources[0]) && is_one(sources[1]);
  }
};

/// Reads and checks all that was typed, also whether the output can be written. All errors at once.
ComparePlan plan_compare(const CompareArguments& arguments);

Command compare_command();

}  // namespace repose::cli
