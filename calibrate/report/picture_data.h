#pragma once

#include <string>

#include "calibrate/report/document.h"
#include "calibrate/report/measure_report.h"
#include "vision/picture/picture.h"

namespace repose::calibrate::report {

/// The picture as JPEG, scaled down so that no side exceeds `longest_side_px`.
PageJpeg page_jpeg(const vision::Picture& picture, int longest_side_px);

ShownPicture shown_jpeg(const PageJpeg& jpeg, const std::string& alt, const std::string& caption);

/// page_jpeg() and shown_jpeg() in one call.
ShownPicture shown_picture(const vision::Picture& picture, int longest_side_px,
                           const std::string& alt, const std::string& caption);

/// Longest side for this number of pictures such that the page can still be sent by e-mail.
int longest_side_px(std::size_t pictures);

}  // namespace repose::calibrate::report
