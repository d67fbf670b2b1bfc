#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vision/drawing/canvas.h"
#include "vision/drawing/lettering.h"
#include "vision/drawing/text_rows.h"
#include "vision/picture/picture.h"

/// What the overlays of all tracked experiments have in common.
namespace repose::vision {

/// @throws std::invalid_argument  there is no picture to draw into.
void require_strobe(const Picture& strobe, const std::string& title, const std::string& reason);

/// A text beside a point, on a plate so that it can be read on any ground.
/// @param column  how far beside, so that those of one place stand side by side
void draw_label(const Canvas& canvas, const Point& point, const std::string& text,
                std::size_t column, const Lettering& lettering);

/// The image with texts below it.
Picture with_caption(const cv::Mat& image, const std::vector<TextRow>& rows,
                     const Lettering& lettering);

}  // namespace repose::vision
