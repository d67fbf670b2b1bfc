#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibrate/report/study_report.h"
#include "vision/drawing/overlay.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

namespace repose::calibrate::report {

/// A picture as it is put into a page.
struct PageJpeg {
  std::vector<std::uint8_t> bytes;
  int width = 0;
  int height = 0;
  /// Of the picture that is measured in it; 0: its pixels are not told.
  int picture_width = 0;
  int picture_height = 0;
  vision::OverlaidArea area = {};
};

/// A picture with what was measured drawn in, as large as a page with so many has room for.
PageJpeg overlay_for_page(const vision::Picture& picture, const vision::ReposeAngle& angle,
                          const vision::OverlayNotes& notes, std::size_t pictures);

/// An overlay that is drawn already, as of a scan, likewise.
PageJpeg page_overlay(const vision::Picture& overlay, std::size_t pictures);

/// A picture of a batch.
struct MeasuredPhotograph {
  std::string file;
  std::string error;          ///< why it was not read; empty: it was
  vision::ReposeAngle angle;  ///< or the refusal
  PageJpeg overlay;           ///< without bytes: not shown
  std::string heap = {};      ///< as calibrate::SetPicture::heap
  std::string command = {};   ///< that measures it so; empty: not told
};

/// A page about a batch of pictures, as `repose measure` measured them: the mean of those that
/// gave a number and its interval, each picture with its overlay, and why some gave no number.
/// @param options  that they were measured with
Report measure_report(const std::vector<MeasuredPhotograph>& pictures,
                      const vision::MeasureOptions& options = {});

}  // namespace repose::calibrate::report
