#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/report/document.h"
#include "calibrate/report/reported_study.h"

namespace repose::calibrate::report {

/// Everything that is seen of the heaps: photographs measured again, the simulated heap drawn and
/// measured in the same way, and both outlines.
struct HeapPictures {
  std::vector<ShownPicture> photographs;       ///< of the bench, with what was measured
  bool is_scanned = false;                     ///< they are silhouettes of scans
  std::optional<std::size_t> best_photograph;  ///< one that counted: see heap_pictures

  std::vector<ShownPicture> renders;  ///< silhouettes, with what was measured
  std::size_t best_render = 0;        ///< the first that gave an angle
  std::optional<ShownPicture> look;   ///< as a camera would see the simulated heap
  std::optional<ShownPicture> outlines;
  std::optional<Chart> outline_chart;
  std::optional<Table> comparison;
  std::optional<Chart> heap_model;   ///< the 3-D view
  std::vector<std::string> remarks;  ///< what is not there, and why
  /// By which the study reads them (base/angle_definition.h); empty: by the usual one. Pictures
  /// show the usual one.
  std::string definition;
};

/// The photograph that stands for all is the one among those of the mean, without a flag if there
/// is one, whose angle is nearest to the mean.
HeapPictures heap_pictures(const ReportedStudy& study);

/// The first photographs, the simulated heap, and both compared.
Chapter heap_chapter(const HeapPictures& pictures);
/// The other photographs, and the 3-D view.
Chapter more_heaps_chapter(const HeapPictures& pictures);

}  // namespace repose::calibrate::report
