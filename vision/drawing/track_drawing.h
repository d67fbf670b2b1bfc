#pragma once

#include <string>
#include <vector>

#include "vision/drawing/canvas.h"
#include "vision/picture/picture.h"
#include "vision/track/track.h"

/// Shared by the overlays of all tracked experiments.
namespace repose::vision {

/// @throws base::InputError  there is no picture to draw on.
void require_strobe(const Picture& strobe, const std::string& title, const std::string& reason);

/// The grain's centre in each frame.
void draw_path(const Canvas& canvas, const std::vector<GrainPlace>& places);

/// The outline of the board that gives the scale, if there is one.
void draw_board(const Canvas& canvas, const std::vector<Point>& board);

/// Why there is no result, and every warning.
void add_verdict(MeasureStatus status, const std::string& reason,
                 const std::vector<Warning>& warnings, std::vector<TextRow>& rows);

/// Text beside a point, on a plate so that it is legible on any background.
/// @param taken  areas of existing labels, which are avoided; the new one is added
void draw_label(const Canvas& canvas, const Point& point, const std::string& text,
                const Lettering& lettering, std::vector<cv::Rect>& taken);

/// The image with texts below it.
Picture with_caption(const cv::Mat& image, const std::vector<TextRow>& rows,
                     const Lettering& lettering);

}  // namespace repose::vision
