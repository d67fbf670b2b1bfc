#include "vision/drawing/overlay.h"

#include <algorithm>

#include <opencv2/core.hpp>

#include "base/input_error.h"
#include "vision/drawing/drawn_size.h"
#include "vision/drawing/lettering.h"
#include "vision/drawing/overlay_caption.h"
#include "vision/drawing/overlay_marks.h"
#include "vision/drawing/overlay_style.h"
#include "vision/picture/mat_of_picture.h"

namespace repose::vision {

Picture draw_overlay(const Picture& picture, const ReposeAngle& measured,
                     const OverlayNotes& notes) {
  if (picture.empty()) {
    throw base::InputError({.where = "overlay",
                            .value = "the picture has no pixels",
                            .fix = "give the picture that was measured."});
  }
  const Lettering lettering;
  const double scale = drawing_scale(picture);
  cv::Mat image = scaled(picture, scale);
  draw_marks(image, scale, measured, notes, lettering);
  const int width = std::max(image.cols, kSmallestCaption);
  const cv::Mat caption = draw_caption(width, measured, notes, lettering);

  Picture overlay = blank_picture(width, image.rows + caption.rows);
  cv::Mat whole = mat_of(overlay);
  whole.setTo(kDark);
  image.copyTo(whole(cv::Rect({(width - image.cols) / 2, 0}, image.size())));
  caption.copyTo(whole(cv::Rect({0, image.rows}, caption.size())));
  return overlay;
}

}  // namespace repose::vision
