#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibrate/report/study_report.h"
#include "vision/drawing/overlay.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

namespace repose::calibrate::report {

/// A picture as embedded in a page.
struct PageJpeg {
  std::vector<std::uint8_t> bytes;
  int width = 0;
  int height = 0;
  /// Size of the measured picture that it shows; 0: its pixel coordinates are not shown.
  int picture_width = 0;
  int picture_height = 0;
  vision::OverlaidArea area = {};
};

/// A picture with the measurement drawn in, as large as a page with that many pictures has room
/// for.
PageJpeg overlay_for_page(const vision::Picture& picture, const vision::ReposeAngle& angle,
                          const vision::OverlayNotes& notes, std::size_t pictures);

/// The same for an overlay that is already drawn, such as a scan's.
PageJpeg page_overlay(const vision::Picture& overlay, std::size_t pictures);

/// A picture of a batch.
struct MeasuredPhotograph {
  std::string file;
  std::string error;          ///< why it could not be read; empty: it was read
  vision::ReposeAngle angle;  ///< or the refusal
  PageJpeg overlay;           ///< no bytes: not shown
  std::string heap = {};      ///< as calibrate::SetPicture::heap
  std::string command = {};   ///< that measures it this way; empty: not shown
};

/// A page about a batch of pictures measured by `repose measure`: the mean of those that gave a
/// number and its interval, each picture with its overlay, and why some gave no number.
/// @param options  with which they were measured
Report measure_report(const std::vector<MeasuredPhotograph>& pictures,
                      const vision::MeasureOptions& options = {});

}  // namespace repose::calibrate::report
