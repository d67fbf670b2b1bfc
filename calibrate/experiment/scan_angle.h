#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"
#include "vision/scan/scanned_heap.h"

/// The angle of a scanned heap as pictures show it. The scan's own angle is a mean over slices, but
/// simulated heaps and photographs are measured in silhouettes, which give a different one: see
/// measuring.md.

namespace repose::calibrate {

struct ScanViews {
  /// From kHeapViews directions, equally spaced over half a turn.
  std::vector<vision::ReposeAngle> views;
  std::size_t typical = 0;                  ///< the view whose angle is nearest to the mean
  vision::Picture typical_picture;          ///< empty: no view has an angle
  std::optional<double> between_views_rad;  ///< standard deviation
  std::optional<double> m_per_px;           ///< of all views; std::nullopt: the unit is unknown
  /// As mean_of_views(). Its interval includes, in quadrature, that of the scan's own angle: noise,
  /// ground and gaps shift all views at once. Also refused and flagged as the scan is, with its
  /// reason and warnings.
  vision::ReposeAngle angle;
};

/// The result does not depend on the number of threads.
/// @throws base::InputError  as vision::measure_repose_angle().
ScanViews measure_scan_views(const vision::ScannedHeap& scan,
                             const vision::MeasureOptions& options = {});

/// Of a file, in the unit that its format implies.
/// @throws base::InputError  also as vision::read_scan() and vision::measure_scan().
ScanViews measure_scan_file(const std::filesystem::path& file,
                            const vision::MeasureOptions& options = {});

}  // namespace repose::calibrate
