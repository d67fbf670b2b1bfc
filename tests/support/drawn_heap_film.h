#pragma once

#include <vector>

#include "tests/support/heap_scene.h"
#include "vision/picture/picture.h"

/// Films of heaps that grow and come to rest, drawn with a known angle.
namespace repose::testing {

struct DrawnHeapFilm {
  /// Of the heap at rest. Its own noise is ignored: each frame has its own.
  HeapScene scene;
  double frames_per_s = 12;
  double grows_s = .5;     ///< with grains falling
  double grows_from = .5;  ///< initial fraction of its size; 0: no heap at first
  double rests_s = 1.2;    ///< after that
  double hand_s = 0;       ///< after that, while a hand comes in from the right
  double noise = 3;        ///< standard deviation of a grey level
  double flicker = 0;  ///< relative amplitude of the light's flicker, in bands across the picture
  bool has_timer = false;  ///< shows tenths of a second in a corner

  int frames() const;
  double time_s(int frame) const { return frame / frames_per_s; }
  /// All frames; the angle is that of heap_truth(scene).
  std::vector<vision::Picture> pictures() const;
};

/// A scene whose film has few pixels: by default, just enough to measure an angle.
HeapScene small_heap(std::uint64_t seed = 1, int width = 480);

}  // namespace repose::testing
