#include "vision/drawing/tilt_overlay.h"

#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "vision/drawing/drawn_size.h"
#include "vision/drawing/track_drawing.h"

namespace repose::vision {
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
