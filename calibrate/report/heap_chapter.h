#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/report/document.h"
#include "calibrate/report/reported_study.h"

namespace repose::calibrate::report {

/// All pictures of the heaps: photographs measured again, the simulated heap drawn and measured in
/// the same way, and both outlines.
struct HeapPictures {
  std::vector<ShownPicture> photographs;       ///< of the bench, with the measurement drawn in
  bool is_scanned = false;                     ///< they are silhouettes of scans
  std::optional<std::size_t> best_photograph;  ///< one that counts: see heap_pictures

  std::vector<ShownPicture> renders;  ///< silhouettes, with the measurement drawn in
  std::size_t best_render = 0;        ///< the first that gave an angle
  std::optional<ShownPicture> look;   ///< the simulated heap as a camera would see it
  std::optional<ShownPicture> outlines;
  std::optional<Chart> outline_chart;
  std::optional<Table> comparison;
  std::optional<Chart> heap_model;   ///< the 3-D view
  std::vector<std::string> remarks;  ///< what is missing, and why
  /// The definition by which the study reads them (base/angle_definition.h); empty: the default.
  /// Pictures show the default.
  std::string definition;
};

/// The representative photograph is, among those in the mean (unflagged ones if any), the one whose
/// angle is nearest to the mean.
HeapPictures heap_pictures(const ReportedStudy& study);

/// The first photographs, the simulated heap, and both compared.
Chapter heap_chapter(const HeapPictures& pictures);
/// The other photographs, and the 3-D view.
Chapter more_heaps_chapter(const HeapPictures& pictures);

}  // namespace repose::calibrate::report
