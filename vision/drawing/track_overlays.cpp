#include "vision/drawing/track_overlays.h"

#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "vision/drawing/canvas.h"
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

namespace {

void draw_lines(const Canvas& canvas, const RollTrack& track) {
  if (track.has_reading) {
    canvas.draw(canvas.path_of({track.released, track.corner, track.stopped}), kSkyBlue, 1);
  }
  draw_path(canvas, track.places);
}

void draw_places(const Canvas& canvas, const RollTrack& track, const Lettering& lettering) {
  std::vector<cv::Rect> labels;
  for (const auto& [place, name] :
       {std::pair(track.released, "let go"), {track.foot, "foot"}, {track.stopped, "at rest"}}) {
    const cv::Point2d at = canvas.at(place);
    const cv::Point2d up(0, canvas.length(.015));
    canvas.draw({at - up, at + up}, kVermilion, 1.2);
    draw_label(canvas, place, name, lettering, labels);
  }
}

std::vector<TextRow> rows_of(const RollTrack& track, const std::string& title) {
  std::vector<TextRow> rows = {{title, kDark}};
  if (track.has_reading) {
    rows.push_back(
        {fmt::format("at rest {:.1f} ± {:.1f} mm from the foot, after {:.2f} s",
                     track.stopped_mm.value, track.stopped_mm.uncertainty, track.stopped_s),
         kDark});
    rows.push_back({fmt::format("let go {:.1f} ± {:.1f} mm up an incline of {:.2f} ± {:.2f}°",
                                track.released_mm.value, track.released_mm.uncertainty,
                                track.incline_deg.value, track.incline_deg.uncertainty),
                    kDark});
  }
  add_verdict(track.status, track.reason, track.warnings, rows);
  return rows;
}

}  // namespace

Picture draw_roll_overlay(const RollTrack& track, const std::string& title) {
  require_strobe(track.strobe, title, track.reason);
  const Lettering lettering;
  const double scale = drawing_scale(track.strobe);
  cv::Mat image = scaled(track.strobe, scale);
  const Canvas canvas(image, scale);
  draw_board(canvas, track.board);
  draw_lines(canvas, track);
  if (track.has_reading) draw_places(canvas, track, lettering);
  return with_caption(image, rows_of(track, title), lettering);
}

namespace {

void draw_edges(const Canvas& canvas, const TiltTrack& track) {
  const auto path = [&](const Segment& edge) { return canvas.path_of({edge.from, edge.to}); };
  canvas.draw_dashed(path(track.level_edge), kSkyBlue, 1);
  canvas.draw(path(track.onset_edge), kSkyBlue, 1);
}

void draw_onset(const Canvas& canvas, const TiltTrack& track, const Lettering& lettering) {
  const cv::Point2d up(0, canvas.length(.02));
  const cv::Point2d at = canvas.at(track.onset);
  canvas.draw({at - up, at + up}, kVermilion, 1.2);
  std::vector<cv::Rect> labels;
  draw_label(canvas, track.onset, "onset", lettering, labels);
}

std::vector<TextRow> rows_of(const TiltTrack& track, const std::string& title) {
  std::vector<TextRow> rows = {{title, kDark}};
  if (track.has_reading) {
    rows.push_back({fmt::format("slides at {:.2f} ± {:.2f}°, after {:.2f} s", track.angle_deg.value,
                                track.angle_deg.uncertainty, track.onset_s),
                    kDark});
    rows.push_back({fmt::format("tilted by {:.3f} ± {:.3f}°/s from the dashed edge on",
                                track.rate_deg_s.value, track.rate_deg_s.uncertainty),
                    kDark});
  }
  add_verdict(track.status, track.reason, track.warnings, rows);
  return rows;
}

}  // namespace

Picture draw_tilt_overlay(const TiltTrack& track, const std::string& title) {
  require_strobe(track.strobe, title, track.reason);
  const Lettering lettering;
  const double scale = drawing_scale(track.strobe);
  cv::Mat image = scaled(track.strobe, scale);
  const Canvas canvas(image, scale);
  if (track.has_reading) draw_edges(canvas, track);
  draw_path(canvas, track.places);
  if (track.has_reading) draw_onset(canvas, track, lettering);
  return with_caption(image, rows_of(track, title), lettering);
}

}  // namespace repose::vision
