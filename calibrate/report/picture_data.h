#pragma once

#include <string>

#include "calibrate/report/document.h"
#include "calibrate/report/measure_report.h"
#include "vision/picture/picture.h"

namespace repose::calibrate::report {

/// The picture as JPEG, made smaller until no side is longer than that.
PageJpeg page_jpeg(const vision::Picture& picture, int longest_side_px);

ShownPicture shown_jpeg(const PageJpeg& jpeg, const std::string& alt, const std::string& caption);

/// Both at once.
ShownPicture shown_picture(const vision::Picture& picture, int longest_side_px,
                           const std::string& alt, const std::string& caption);

/// How large so many pictures may be, so that the page stays one that can be sent by e-mail.
int longest_side_px(std::size_t pictures);

}  // namespace repose::calibrate::report
