#include "vision/drawing/drop_overlay.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "vision/drawing/canvas.h"
#include "vision/drawing/drawn_size.h"
#include "vision/drawing/lettering.h"
#include "vision/drawing/overlay_style.h"
#include "vision/drawing/text_rows.h"
#include "vision/picture/mat_of_picture.h"

namespace repose::vision {
namespace {

/// A text beside a point, on a plate so that it can be read on any ground.
/// @param column  how far beside, so that those of one place stand side by side
void label(const Canvas& canvas, const Point& point, const std::string& text, std::size_t column,
           const Lettering& lettering) {
  const int height = std::max(12, cvRound(canvas.length(.018)));
  const int pad = height / 3;
  const cv::Size size(lettering.width(text, height) + 2 * pad, height + 2 * pad);
  cv::Point at(canvas.at(point) +
               cv::Point2d((2 + 2.2 * static_cast<double>(column)) * height, -.5 * size.height));
  at.x = std::clamp(at.x, 0, std::max(0, canvas.image().cols - size.width));
  at.y = std::clamp(at.y, 0, std::max(0, canvas.image().rows - size.height));
  cv::rectangle(canvas.image(), cv::Rect(at, size), kDark, cv::FILLED);
  lettering.draw(canvas.image(), text, at + cv::Point(pad, pad), height, kWhite);
}

void draw_flights(const Canvas& canvas, const DropTrack& track) {
  for (const FlightPath& flight : track.flights) {
    canvas.draw(canvas.path_of(flight.curve), kSkyBlue, 1);
    if (!flight.has_top) continue;
    cv::circle(canvas.image(), canvas.at(flight.top), cvRound(canvas.length(.006)), kYellow,
               canvas.stroke(1), cv::LINE_AA);
  }
  for (const GrainPlace& place : track.places) {
    cv::circle(canvas.image(), canvas.at(place.centre), canvas.stroke(.6), kOrange, cv::FILLED,
               cv::LINE_AA);
  }
}

void draw_impacts(const Canvas& canvas, const DropTrack& track, const Lettering& lettering) {
  const double arm = .015;
  for (std::size_t k = 0; k < track.bounces.size(); ++k) {
    const cv::Point2d at = canvas.at(track.bounces[k].place);
    const cv::Point2d across(canvas.length(arm), 0);
    canvas.draw({at - across, at + across}, kVermilion, 1.2);
    label(canvas, track.bounces[k].place, fmt::format("{}", k + 1), k, lettering);
  }
}

std::vector<TextRow> rows_of(const DropTrack& track, const std::string& title) {
  std::vector<TextRow> rows = {{title, kDark}};
  for (std::size_t k = 0; k < track.bounces.size(); ++k) {
    const Bounce& bounce = track.bounces[k];
    rows.push_back(
        {fmt::format("{}: at {:.3f} s, restitution {:.3f} ± {:.3f}, from {:.1f} mm to "
                     "{:.1f} mm",
                     k + 1, bounce.time_s, bounce.restitution.value, bounce.restitution.uncertainty,
                     bounce.drop_mm.value, bounce.rebound_mm.value),
         kDark});
  }
  if (track.status == MeasureStatus::refused)
    rows.push_back({"refused: " + track.reason, kVermilion});
  for (const Warning& warning : track.warnings)
    rows.push_back({"! " + warning.message, kVermilion});
  return rows;
}

}  // namespace

Picture draw_drop_overlay(const DropTrack& track, const std::string& title) {
  if (track.strobe.empty()) {
    throw std::invalid_argument(fmt::format(
        "{}: there is no picture to draw into: the film was not looked through. Fix: {}", title,
        track.reason));
  }
  const Lettering lettering;
  const double scale = drawing_scale(track.strobe);
  cv::Mat image = scaled(track.strobe, scale);
  const Canvas canvas(image, scale);
  draw_flights(canvas, track);
  draw_impacts(canvas, track, lettering);
  const int width = std::max(image.cols, kSmallestCaption);
  const cv::Mat caption = draw_text_rows(width, rows_of(track, title), lettering);

  Picture overlay = blank_picture(width, image.rows + caption.rows);
  cv::Mat whole = mat_of(overlay);
  whole.setTo(kWhite);
  image.copyTo(whole(cv::Rect({(width - image.cols) / 2, 0}, image.size())));
  caption.copyTo(whole(cv::Rect({0, image.rows}, caption.size())));
  return overlay;
}

}  // namespace repose::vision
