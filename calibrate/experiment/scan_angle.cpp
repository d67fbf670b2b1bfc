#include "calibrate/experiment/scan_angle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <tbb/parallel_for.h>

#include "calibrate/experiment/heap_angle.h"
#include "calibrate/experiment/view_mean.h"
#include "vision/scan/scan_file.h"
#include "vision/scan/scan_silhouette.h"

namespace repose::calibrate {
namespace {

double azimuth_rad(int view) { return std::numbers::pi * view / kHeapViews; }

/// Adds the scan's own uncertainty, flag and warnings to the views' mean.
void add_scan(const vision::ReposeAngle& scan, vision::ReposeAngle& seen) {
  if (seen.status == vision::MeasureStatus::refused) return;
  for (auto* width : {&seen.uncertainty_rad, &seen.own_uncertainty_rad}) {
    if (*width) *width = std::hypot(**width, scan.uncertainty_rad.value_or(0));
  }
  if (scan.status == vision::MeasureStatus::flagged) seen.status = scan.status;
  for (const vision::Warning& warning : scan.warnings) {
    const auto is_same = [&](const vision::Warning& one) { return one.code == warning.code; };
    if (std::ranges::none_of(seen.warnings, is_same)) seen.warnings.push_back(warning);
  }
}

}  // namespace

ScanViews measure_scan_views(const vision::ScannedHeap& scan,
                             const vision::MeasureOptions& options) {
  ScanViews seen;
  seen.angle.definition = options.named_definition();
  if (scan.angle.status == vision::MeasureStatus::refused) {
    seen.angle.reason = scan.angle.reason;
    seen.views.assign(kHeapViews, seen.angle);
    return seen;
  }
  const vision::ScanSilhouettes silhouettes(scan);
  seen.m_per_px = silhouettes.m_per_px();
  seen.views.resize(kHeapViews);
  tbb::parallel_for(0, kHeapViews, [&](int view) {
    seen.views[static_cast<std::size_t>(view)] =
        vision::measure_repose_angle(silhouettes.seen_from(azimuth_rad(view)), options);
  });
  seen.between_views_rad = sd_between_views(seen.views);
  seen.angle = mean_of_views(seen.views);
  add_scan(scan.angle, seen.angle);
  if (!seen.angle.angle_rad) return seen;
  const auto off = [&](const vision::ReposeAngle& view) {
    return view.angle_rad ? std::abs(*view.angle_rad - *seen.angle.angle_rad)
                          : std::numeric_limits<double>::infinity();
  };
  seen.typical =
      static_cast<std::size_t>(std::ranges::min_element(seen.views, {}, off) - seen.views.begin());
  seen.typical_picture = silhouettes.seen_from(azimuth_rad(static_cast<int>(seen.typical)));
  return seen;
}

ScanViews measure_scan_file(const std::filesystem::path& file,
                            const vision::MeasureOptions& options) {
  const vision::ScannedHeap scan =
      vision::measure_scan(vision::read_scan(file), {.unit_mm = {},
                                                     .ground = {},
                                                     .window_from = options.window_from,
                                                     .window_to = options.window_to,
                                                     .names = options.names});
  return measure_scan_views(scan, options);
}

}  // namespace repose::calibrate
