#pragma once

#include <optional>

#include "vision/picture/picture.h"
#include "vision/scan/scanned_heap.h"

/// A scanned heap as a camera sees it that is far away and level: black before white, as simulated
/// heaps are drawn, so that it can be measured and compared as a photograph is.

namespace repose::vision {

/// How a scan's silhouettes are drawn: at one scale from all sides.
class ScanSilhouettes {
 public:
  /// @param heap  that was not refused: its map is needed
  /// @throws base::InputError  it was refused, with its reason.
  explicit ScanSilhouettes(const ScannedHeap& heap);

  /// None: the file's unit is not known.
  std::optional<double> m_per_px() const { return m_per_px_; }

  /// The silhouette of the surface over the heap's base and toe. Between the middles of
  /// neighbouring cells the surface is a plane's edge, so that its silhouette is that of these
  /// edges.
  /// @param azimuth_rad  the direction of the picture's right, about the axis
  Picture seen_from(double azimuth_rad) const;

 private:
  ScanMap map_;
  double length_px_ = 1;  ///< of a pixel, in the file's unit
  int width_ = 0;
  int height_ = 0;
  std::optional<double> m_per_px_;
};

}  // namespace repose::vision
