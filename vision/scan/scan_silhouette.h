#pragma once

#include <optional>

#include "vision/picture/picture.h"
#include "vision/scan/scanned_heap.h"

/// A scanned heap as seen by a distant, level camera: black on white, like the pictures of
/// simulated heaps, so that it can be measured and compared like a photograph.

namespace repose::vision {

/// Draws a scan's silhouettes, at one scale from all sides.
class ScanSilhouettes {
 public:
  /// @param heap  not refused, as its map is needed
  /// @throws base::InputError  it was refused, with its reason.
  explicit ScanSilhouettes(const ScannedHeap& heap);

  /// std::nullopt: the file's unit is unknown.
  std::optional<double> m_per_px() const { return m_per_px_; }

  /// The silhouette of the surface over the heap's base and toe. The centres of neighbouring cells
  /// are joined by straight edges, whose silhouette is drawn.
  /// @param azimuth_rad  the direction of the picture's right-hand side, about the axis
  Picture seen_from(double azimuth_rad) const;

 private:
  ScanMap map_;
  double length_px_ = 1;  ///< of a pixel, in the file's unit
  int width_ = 0;
  int height_ = 0;
  std::optional<double> m_per_px_;
};

}  // namespace repose::vision
