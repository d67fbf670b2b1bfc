#include "vision/drawing/drop_overlay.h"

#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "vision/drawing/canvas.h"
#include "vision/drawing/drawn_size.h"
#include "vision/drawing/lettering.h"
#include "vision/drawing/overlay_style.h"
#include "vision/drawing/text_rows.h"
#include "vision/drawing/track_drawing.h"

namespace repose::vision {
namespace {

void draw_flights(const Canvas& canvas, const DropTrack& track) {
  for (const FlightPath& flight : track.flights) {
    canvas.draw(canvas.path_of(flight.curve), kSkyBlue, 1);
    if (!flight.has_top) continue;
    cv::circle(canvas.image(), canvas.at(flight.top), cvRound(canvas.length(.006)), kYellow,
               canvas.stroke(1), cv::LINE_AA);
  }
  draw_path(canvas, track.places);
}

void draw_impacts(const Canvas& canvas, const DropTrack& track, const Lettering& lettering) {
  const double arm = .015;
  std::vector<cv::Rect> labels;
  for (const Bounce& bounce : track.bounces) {
    const cv::Point2d at = canvas.at(bounce.place);
    const cv::Point2d across(canvas.length(arm), 0);
    canvas.draw({at - across, at + across}, kVermilion, 1.2);
    draw_label(canvas, bounce.place, fmt::format("{}", bounce.number), lettering, labels);
  }
}

std::vector<TextRow> rows_of(const DropTrack& track, const std::string& title) {
  std::vector<TextRow> rows = {{title, kDark}};
  for (const Bounce& bounce : track.bounces) {
    rows.push_back(
        {fmt::format("{}: at {:.3f} s, restitution {:.3f} ± {:.3f}, from {:.1f} mm to "
                     "{:.1f} mm",
                     bounce.number, bounce.time_s, bounce.restitution.value,
                     bounce.restitution.uncertainty, bounce.drop_mm.value, bounce.rebound_mm.value),
         kDark});
  }
  add_verdict(track.status, track.reason, track.warnings, rows);
  return rows;
}

}  // namespace

Picture draw_drop_overlay(const DropTrack& track, const std::string& title) {
  require_strobe(track.strobe, title, track.reason);
  const Lettering lettering;
  const double scale = drawing_scale(track.strobe);
  cv::Mat image = scaled(track.strobe, scale);
  const Canvas canvas(image, scale);
  draw_board(canvas, track.board);
  draw_flights(canvas, track);
  draw_impacts(canvas, track, lettering);
  return with_caption(image, rows_of(track, title), lettering);
}

}  // namespace repose::vision
