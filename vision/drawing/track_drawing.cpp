#include "vision/drawing/track_drawing.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

#include "base/input_error.h"
#include "vision/drawing/canvas.h"
#include "vision/picture/opencv.h"

namespace repose::vision {

void require_strobe(const Picture& strobe, const std::string& title, const std::string& reason) {
  if (!strobe.empty()) return;
  throw base::InputError(
      {.where = title,
       .value = "there is no picture to draw into: the film was not looked through",
       .fix = reason});
}

void draw_path(const Canvas& canvas, const std::vector<GrainPlace>& places) {
  for (const GrainPlace& place : places) {
    cv::circle(canvas.image(), canvas.at(place.centre), canvas.stroke(.6), kOrange, cv::FILLED,
               cv::LINE_AA);
  }
}

void draw_board(const Canvas& canvas, const std::vector<Point>& board) {
  if (board.empty()) return;
  std::vector<Point> closed = board;
  closed.push_back(board.front());
  canvas.draw(canvas.path_of(closed), kYellow, 1);
}

void add_verdict(MeasureStatus status, const std::string& reason,
                 const std::vector<Warning>& warnings, std::vector<TextRow>& rows) {
  if (status == MeasureStatus::refused) rows.push_back({"refused: " + reason, kVermilion});
  for (const Warning& warning : warnings) rows.push_back({"! " + warning.message, kVermilion});
}

void draw_label(const Canvas& canvas, const Point& point, const std::string& text,
                const Lettering& lettering, std::vector<cv::Rect>& taken) {
  const int height = std::max(12, cvRound(canvas.length(.018)));
  const int pad = height / 3;
  const cv::Size size(lettering.width(text, height) + 2 * pad, height + 2 * pad);
  const cv::Size image = canvas.image().size();
  cv::Point at(canvas.at(point) + cv::Point2d(2 * height, -.5 * size.height));
  at.x = std::clamp(at.x, 0, std::max(0, image.width - size.width));
  at.y = std::clamp(at.y, 0, std::max(0, image.height - size.height));
  const int first_column = at.x;
  // Terminates: each move passes a label, or goes to the next row at the image's edge.
  for (std::size_t k = 0; k < taken.size();) {
    if ((taken[k] & cv::Rect(at, size)).empty()) {
      ++k;
      continue;
    }
    at.x = taken[k].br().x + pad;
    if (at.x + size.width > image.width) at = {first_column, taken[k].br().y + pad};
    k = 0;
  }
  taken.emplace_back(at, size);
  cv::rectangle(canvas.image(), cv::Rect(at, size), kDark, cv::FILLED);
  lettering.draw(canvas.image(), text, at + cv::Point(pad, pad), height, kWhite);
}

Picture with_caption(const cv::Mat& image, const std::vector<TextRow>& rows,
                     const Lettering& lettering) {
  const int width = std::max(image.cols, kSmallestCaption);
  const cv::Mat caption = draw_text_rows(width, rows, lettering);

  Picture overlay = blank_picture(width, image.rows + caption.rows);
  cv::Mat whole = mat_of(overlay);
  whole.setTo(kWhite);
  image.copyTo(whole(cv::Rect({(width - image.cols) / 2, 0}, image.size())));
  caption.copyTo(whole(cv::Rect({0, image.rows}, caption.size())));
  return overlay;
}

}  // namespace repose::vision
