#pragma once

#include <string>
#include <vector>

#include "vision/drawing/canvas.h"
#include "vision/picture/picture.h"
#include "vision/track/track.h"

/// What the overlays of all tracked experiments have in common.
namespace repose::vision {

/// @throws base::InputError  there is no picture to draw into.
void require_strobe(const Picture& strobe, const std::string& title, const std::string& reason);

/// The grain's centre in each frame.
void draw_path(const Canvas& canvas, const std::vector<GrainPlace>& places);

/// The outline of the board that gives the scale, if there is one.
void draw_board(const Canvas& canvas, const std::vector<Point>& board);

/// Why there is no number, and every warning.
void add_verdict(MeasureStatus status, const std::string& reason,
                 const std::vector<Warning>& warnings, std::vector<TextRow>& rows);

/// A text beside a point, on a plate so that it can be read on any ground.
/// @param taken  where labels are already, beside which it is put; its own place is added
void draw_label(const Canvas& canvas, const Point& point, const std::string& text,
                const Lettering& lettering, std::vector<cv::Rect>& taken);

/// The image with texts below it.
Picture with_caption(const cv::Mat& image, const std::vector<TextRow>& rows,
                     const Lettering& lettering);

}  // namespace repose::vision
