#include "vision/drawing/roll_overlay.h"

#include <vector>

#include <fmt/format.h>

#include "vision/drawing/drawn_size.h"
#include "vision/drawing/track_drawing.h"

namespace repose::vision {
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

}  // namespace repose::vision
