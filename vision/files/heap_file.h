#pragma once

#include <filesystem>
#include <optional>

#include "vision/camera/sized_heap.h"
#include "vision/hints/hint_file.h"
#include "vision/picture/picture.h"
#include "vision/scan/scanned_heap.h"

/// A heap measured in a file of any kind.

namespace repose::vision {

struct HeapInFile {
  SizedHeap heap;
  Picture picture;            ///< as read, and turned; for a film the heap at rest, as in FilmAngle
  PictureSettings told = {};  ///< including the hints saved beside it
  bool is_film = false;       ///< by its name
  /// For a three-dimensional scan (judged by its name), whose angle is the heap's; there is no
  /// picture.
  std::optional<ScannedHeap> scan = {};

  /// The picture that was measured; the heap's outline is in its pixels.
  const Picture& measured() const { return heap.corrected.empty() ? picture : heap.corrected; }
};

/// Measures a photograph or a film with the hints saved beside it, or a scan.
/// @param given  further settings, as in with_saved_hints()
/// @throws base::InputError  "FILE: what. Fix: ...": it cannot be read, or its hints cannot be
///   used; or as measure_sized_heap().
HeapInFile measure_heap_file(const std::filesystem::path& file, const PictureSettings& given = {});

}  // namespace repose::vision
