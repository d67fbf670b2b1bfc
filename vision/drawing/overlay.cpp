#include "vision/drawing/overlay.h"

#include <algorithm>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "vision/drawing/lettering.h"
#include "vision/drawing/overlay_caption.h"
#include "vision/drawing/overlay_marks.h"
#include "vision/drawing/overlay_style.h"
#include "vision/picture/mat_of_picture.h"

namespace repose::vision {
namespace {

constexpr int kSmallestSide = 800;     // px; smaller pictures are enlarged by a whole number
constexpr int kLargestSide = 2400;     // px; more than a page of a paper can show
constexpr int kSmallestCaption = 640;  // px wide, beneath narrow pictures

/// How many times larger to draw it: whole numbers keep the pixels of small pictures square.
double drawing_scale(const Picture& picture) {
  const int longest = std::max(picture.width, picture.height);
  if (longest > kLargestSide) return static_cast<double>(kLargestSide) / longest;
  return longest < kSmallestSide ? (kSmallestSide + longest - 1) / longest : 1;
}

cv::Mat scaled(const Picture& picture, double scale) {
  const cv::Size size(std::max(1, cvRound(picture.width * scale)),
                      std::max(1, cvRound(picture.height * scale)));
  cv::Mat result;
  cv::resize(mat_of(picture), result, size, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_NEAREST);
  return result;
}

}  // namespace

Picture draw_overlay(const Picture& picture, const ReposeAngle& measured,
                     const OverlayNotes& notes) {
  if (picture.empty()) {
    throw std::invalid_argument(
        "overlay: the picture has no pixels. Fix: give the picture that was measured.");
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
