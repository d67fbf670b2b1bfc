#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace repose::cli {

/// What a name on the command line stands for: one picture, the pictures of a folder with a heap
/// each, or simulated heaps.
struct HeapSource {
  std::string name;
  std::vector<std::filesystem::path> pictures;
  std::vector<std::filesystem::path> states;  ///< .vtp; never together with pictures
  /// Of each of the `pictures`, once they stand for a heap with several, all that are of it.
  std::vector<std::vector<std::filesystem::path>> views = {};

  /// Files of the heap in that place.
  std::vector<std::filesystem::path> files_of_heap(std::size_t heap) const {
    if (!states.empty()) return {states[heap]};
    return views.empty() ? std::vector{pictures[heap]} : views[heap];
  }

  bool is_one_picture() const { return is_file && states.empty(); }
  bool is_file = true;  ///< not a folder
  std::size_t heaps() const { return pictures.size() + states.size(); }
};

/// A folder stands for the pictures in it; else for the heaps of its subfolder `heaps`, as
/// `repose calibrate` leaves them, or for those in itself, as `repose simulate heap` does. All
/// errors are added.
std::array<HeapSource, 2> heap_sources(const std::vector<std::string>& names,
                                       std::vector<std::string>& errors);

/// A state file by its name.
bool has_state_ending(const std::filesystem::path& file);

}  // namespace repose::cli
