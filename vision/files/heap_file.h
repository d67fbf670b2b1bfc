#pragma once

#include <filesystem>
#include <optional>

#include "vision/camera/sized_heap.h"
#include "vision/hints/hint_file.h"
#include "vision/picture/picture.h"
#include "vision/scan/scanned_heap.h"

/// A heap measured in a file, whatever kind of file it is.

namespace repose::vision {

struct HeapInFile {
  SizedHeap heap;
  Picture picture;  ///< as it was read, and turned; of a film the heap at rest, as in FilmAngle
  PictureSettings told = {};  ///< with the hints that are kept beside it
  bool is_film = false;       ///< by its name
  /// Of a three-dimensional scan, by its name; its angle is the heap's, and there is no picture.
  std::optional<ScannedHeap> scan = {};

  /// The picture that was measured, in whose pixels the heap's outline is.
  const Picture& measured() const { return heap.corrected.empty() ? picture : heap.corrected; }
};

/// Measures a photograph or a film, with the hints that are kept beside it, or a scan.
/// @param given  what is said of it beside that, as with_saved_hints() takes it
/// @throws base::InputError  "FILE: what. Fix: ...": it cannot be read, or its hints cannot be
///   used; or as measure_sized_heap().
HeapInFile measure_heap_file(const std::filesystem::path& file, const PictureSettings& given = {});

}  // namespace repose::vision
