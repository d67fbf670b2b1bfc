#include "vision/drawing/slopes_overlay.h"

#include <opencv2/core.hpp>

#include "base/input_error.h"
#include "vision/drawing/canvas.h"
#include "vision/drawing/track_drawing.h"

namespace repose::vision {

Picture draw_slopes_overlay(const Picture& picture, const std::vector<Slope>& slopes,
                            const std::string& title) {
  if (picture.empty()) {
    throw base::InputError(
        {.where = title, .value = "the picture has no pixels", .fix = "give one that has."});
  }
  const Lettering lettering;
  const double scale = drawing_scale(picture);
  cv::Mat image = scaled(picture, scale);
  const Canvas canvas(image, scale);
  std::vector<TextRow> rows = {{title, kDark}};
  std::vector<cv::Rect> labels;
  for (const Slope& slope : slopes) {
    if (!slope.angle_rad) {
      rows.push_back({slope.name + ": no slope to measure", kVermilion});
      continue;
    }
    const std::string angle = angle_text(*slope.angle_rad, {});
    canvas.draw(canvas.path_of({slope.line.from, slope.line.to}), kVermilion, 1.2);
    const Point middle{.x = (slope.line.from.x + slope.line.to.x) / 2,
                       .y = (slope.line.from.y + slope.line.to.y) / 2};
    draw_label(canvas, middle, angle, lettering, labels);
    rows.push_back({slope.name + ": " + angle, kDark});
  }
  return with_caption(image, rows, lettering);
}

}  // namespace repose::vision
