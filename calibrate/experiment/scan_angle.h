#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"
#include "vision/scan/scanned_heap.h"

/// The angle of a scanned heap as pictures show it. Its own is a mean over slices, and simulated
/// heaps and photographs are read in silhouettes, which show another one: see measuring.md.

namespace repose::calibrate {

struct ScanViews {
  /// From kHeapViews sides, equally spaced over half a turn.
  std::vector<vision::ReposeAngle> views;
  std::size_t typical = 0;                  ///< the view whose angle is nearest to the mean
  vision::Picture typical_picture;          ///< empty: no view has an angle
  std::optional<double> between_views_rad;  ///< standard deviation
  std::optional<double> m_per_px;           ///< of all of them; none: the unit is not known
  /// As mean_of_views(). Its interval holds in quadrature that of the scan's own angle, too: noise,
  /// ground and gaps move all views at once. Refused and flagged as the scan is, with its reason
  /// and warnings.
  vision::ReposeAngle angle;
};

/// The same at any number of threads.
/// @throws base::InputError  as vision::measure_repose_angle().
ScanViews measure_scan_views(const vision::ScannedHeap& scan,
                             const vision::MeasureOptions& options = {});

/// Of a file, with what its format says of its unit.
/// @throws base::InputError  as vision::read_scan() and vision::measure_scan(), too.
ScanViews measure_scan_file(const std::filesystem::path& file,
                            const vision::MeasureOptions& options = {});

}  // namespace repose::calibrate
