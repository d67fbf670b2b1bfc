#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace repose::calibrate {

/// The heap, or a folder's heaps, that a name stands for.
struct HeapSource {
  enum class Kind {
    pictures,
    simulated,  ///< states of repose, or particles of another program
    scans,
  };
  std::string name;
  Kind kind = Kind::pictures;
  std::vector<std::filesystem::path> files;  ///< one heap each
  /// Once pictures are grouped by heap: all pictures of each heap.
  std::vector<std::vector<std::filesystem::path>> views = {};
  bool is_file = true;  ///< not a folder

  /// Files of the heap at this index.
  std::vector<std::filesystem::path> files_of_heap(std::size_t heap) const {
    return views.empty() ? std::vector{files[heap]} : views[heap];
  }
  /// Whether their views are rendered here, from all around.
  bool is_drawn() const { return kind != Kind::pictures; }
};

/// By its name; particle files also by their content.
HeapSource::Kind kind_of_heap(const std::filesystem::path& file);

/// A folder stands for the pictures in it; else for the scans; else for the heap states in its
/// subfolder `heaps`, as `repose calibrate` writes them, or in itself, as `repose simulate heap`
/// does; else for the particle files in it. All errors are added.
std::array<HeapSource, 2> heap_sources(const std::vector<std::string>& names,
                                       std::vector<std::string>& errors);

/// "pictures", "scanned" or "simulated".
const char* name_of(HeapSource::Kind kind);

/// The name of a set in tables and figures.
std::string title_of(const HeapSource& source);

}  // namespace repose::calibrate
