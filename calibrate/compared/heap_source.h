#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace repose::calibrate {

/// What a name stands for: one heap, or those of a folder.
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

/// By its name, and of particles by what is in it.
HeapSource::Kind kind_of_heap(const std::filesystem::path& file);

/// A folder stands for the pictures in it; else for the scans; else for the heaps of its subfolder
/// `heaps`, as `repose calibrate` leaves them, or for those in itself, as `repose simulate heap`
/// does. All errors are added.
std::array<HeapSource, 2> heap_sources(const std::vector<std::string>& names,
                                       std::vector<std::string>& errors);

/// "pictures", "scanned" or "simulated".
const char* name_of(HeapSource::Kind kind);

/// What a set is called in tables and figures.
std::string title_of(const HeapSource& source);

}  // namespace repose::calibrate
