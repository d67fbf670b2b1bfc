#pragma once

#include <optional>
#include <vector>

#include "tests/support/heap_scene.h"
#include "vision/picture/picture.h"

/// Pictures of heaps whose angles are exact by construction.
namespace repose::testing {

struct DrawnHeap {
  vision::Picture picture;
  std::optional<double> left_rad;             ///< from the ground line; std::nullopt: no such flank
  std::optional<double> right_rad;            ///< likewise
  double ground_tilt_rad = 0;                 ///< > 0: right end lower
  vision::Segment ground;                     ///< under the base [px]
  std::optional<vision::Segment> left_line;   ///< HeapProfile::flank, toe first [px]
  std::optional<vision::Segment> right_line;  ///< likewise
  std::vector<vision::Point>
      outline;           ///< exact upper edge of the heap's grains, left to right [px]
  double grain_px = 0;   ///< mean diameter
  double height_px = 0;  ///< crest above the ground

  /// Mean of the flanks that exist.
  std::optional<double> mean_rad() const;
};

/// Everything except the picture, which takes most of the time.
DrawnHeap heap_truth(const HeapScene& scene);

/// The same scene gives the same picture.
DrawnHeap draw_heap(const HeapScene& scene);

}  // namespace repose::testing
