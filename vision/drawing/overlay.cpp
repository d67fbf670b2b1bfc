#include "vision/drawing/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "base/angle_definition.h"
#include "base/input_error.h"
#include "vision/drawing/canvas.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/opencv.h"

namespace repose::vision {

namespace {

struct CaptionLine {
  std::string text;
  int height = 0;
  cv::Scalar colour;
};

struct Badge {
  std::string text;
  cv::Scalar colour;
};

Badge badge_of(MeasureStatus status) {
  switch (status) {
    case MeasureStatus::ok:
      return {"ok", kGreen};
    case MeasureStatus::flagged:
      return {"flagged", kOrange};
    case MeasureStatus::refused:
      return {"refused", kVermilion};
  }
  return {};
}

std::string heading(const ReposeAngle& measured) {
  if (!measured.angle_rad) return "no angle";
  return angle_text(*measured.angle_rad, measured.uncertainty_rad);
}

std::string window_text(const std::array<double, 2>& window) {
  return fmt::format("{:.0f}–{:.0f} %", 100 * window[0], 100 * window[1]);
}

/// The window, and the window used on each side where it differs.
std::string windows_of(const ReposeAngle& measured) {
  std::string text = fmt::format("window {} of the height", window_text(measured.window));
  if (!base::is_usual_definition(measured.definition)) text = measured.definition + ", " + text;
  for (const auto& [name, flank] :
       {std::pair("left", &measured.left), {"right", &measured.right}}) {
    if (!flank->window_used || *flank->window_used == measured.window) continue;
    text += fmt::format(", {} {}", name, window_text(*flank->window_used));
  }
  return text;
}

std::string details(const ReposeAngle& measured) {
  std::string text = fmt::format(
      "{} method · {}", measured.method == Method::paper ? "paper" : "auto", windows_of(measured));
  if (measured.ground_tilt_rad) {
    text += fmt::format(" · ground tilt {:.1f}°", to_degrees(*measured.ground_tilt_rad));
  }
  if (!measured.segmentation.empty()) text += " · silhouette: " + measured.segmentation;
  return text + fmt::format(" · confidence {:.2f}", measured.confidence);
}

/// Text in the caption, wrapped to its width.
class Lines {
 public:
  Lines(const Lettering& lettering, int width) : lettering_(lettering), width_(width) {}

  void add(const std::string& text, int height, const cv::Scalar& colour) {
    for (const std::string& line : lettering_.wrap(text, height, width_)) {
      lines_.push_back({line, height, colour});
    }
  }
  const std::vector<CaptionLine>& all() const { return lines_; }

 private:
  const Lettering& lettering_;
  int width_;
  std::vector<CaptionLine> lines_;
};

std::vector<CaptionLine> lines_of(const ReposeAngle& measured, const OverlayNotes& notes,
                                  const Lettering& lettering, int width, int height) {
  Lines lines(lettering, width);
  lines.add(notes.title, height, kWhite);
  if (measured.status == MeasureStatus::refused) lines.add(measured.reason, height, kWhite);
  lines.add(details(measured), height, kGrey);
  for (const Warning& warning : measured.warnings) {
    lines.add("⚠ " + warning.message, height, kYellow);
  }
  return lines.all();
}

void draw_badge(cv::Mat& bar, const Badge& badge, cv::Point top_left, int height,
                const Lettering& lettering) {
  const int pad = height / 2;
  const cv::Rect plate(
      top_left, cv::Size(lettering.width(badge.text, height) + 2 * pad, height + height / 3));
  cv::rectangle(bar, plate, badge.colour, cv::FILLED);
  lettering.draw(bar, badge.text, top_left + cv::Point(pad, height / 6), height, kWhite);
}

/// A bar `width` pixels wide, as high as needed, with the result in words.
cv::Mat draw_caption(int width, const ReposeAngle& measured, const OverlayNotes& notes,
                     const Lettering& lettering) {
  const int height = std::max(14, width / 46);
  const int heading_height = 2 * height;
  const int pad = height;
  const int spacing = height / 3;
  const auto lines = lines_of(measured, notes, lettering, width - 2 * pad, height);

  int bar_height = pad + heading_height + spacing;
  for (const CaptionLine& line : lines) bar_height += line.height + spacing;
  cv::Mat bar(bar_height + pad - spacing, width, CV_8UC3, kDark);

  const std::string head = heading(measured);
  lettering.draw(bar, head, {pad, pad - height / 4}, heading_height, kWhite);
  const int badge_x = pad + lettering.width(head, heading_height) + pad;
  draw_badge(bar, badge_of(measured.status), {badge_x, pad + height / 6}, height, lettering);
  int y = pad + heading_height + spacing;
  for (const CaptionLine& line : lines) {
    lettering.draw(bar, line.text, {pad, y}, line.height, line.colour);
    y += line.height + spacing;
  }
  return bar;
}

constexpr double kDimmed = 0.7;  // remaining brightness outside the heap

void dim_outside(const Canvas& canvas, const std::vector<Point>& outline) {
  if (outline.size() < 3) return;
  std::vector<cv::Point> corners;
  corners.reserve(outline.size());
  for (const Point& point : outline) corners.emplace_back(canvas.at(point));
  cv::Mat inside = cv::Mat::zeros(canvas.image().size(), CV_8U);
  cv::fillPoly(inside, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar(255));
  cv::Mat dimmed = canvas.image() * kDimmed;
  canvas.image().copyTo(dimmed, inside);
  dimmed.copyTo(canvas.image());
}

Path arc(cv::Point2d centre, double radius, double from_rad, double to_rad) {
  constexpr int kSteps = 40;
  Path path;
  for (int step = 0; step <= kSteps; ++step) {
    const double angle = from_rad + (to_rad - from_rad) * step / kSteps;
    path.emplace_back(centre + radius * cv::Point2d(std::cos(angle), std::sin(angle)));
  }
  return path;
}

/// Clockwise from the top left corner.
Path corners_of(const Canvas& canvas, const Box& box) {
  const double left = box.x, top = box.y;
  const double right = left + box.width, bottom = top + box.height;
  return canvas.path_of({{left, top}, {right, top}, {right, bottom}, {left, bottom}});
}

void draw_excluded(const Canvas& canvas, const Box& box) {
  const Path corners = corners_of(canvas, box);
  canvas.draw(corners, kGrey, 0.7, true);
  canvas.draw({corners[0], corners[2]}, kGrey, 0.7);
  canvas.draw({corners[1], corners[3]}, kGrey, 0.7);
}

/// A place marked by the user: a ring on the heap, a cross beside it.
void draw_place(const Canvas& canvas, const Point& place, bool is_heap) {
  const cv::Point2d at = canvas.at(place);
  const double reach = canvas.length(0.01);
  if (is_heap) {
    canvas.draw(arc(at, reach, 0, 2 * std::numbers::pi), kGreen, 0.7, true);
    return;
  }
  const cv::Point2d falling(reach, reach), rising(reach, -reach);
  canvas.draw({at - falling, at + falling}, kVermilion, 0.7);
  canvas.draw({at - rising, at + rising}, kVermilion, 0.7);
}

void draw_hints(const Canvas& canvas, const Hints& hints) {
  if (hints.heap) {
    Path corners = corners_of(canvas, *hints.heap);
    corners.push_back(corners.front());
    canvas.draw_dashed(corners, kWhite, 0.6);
  }
  for (const Point& place : hints.keep) draw_place(canvas, place, true);
  for (const Point& place : hints.drop) draw_place(canvas, place, false);
}

/// Intersection of the lines a and b, each given by two points.
std::optional<cv::Point2d> meeting(cv::Point2d a0, cv::Point2d a1, cv::Point2d b0, cv::Point2d b1) {
  const cv::Point2d a = a1 - a0, b = b1 - b0;
  const double cross = a.cross(b);
  if (std::abs(cross) <= 1e-9 * cv::norm(a) * cv::norm(b)) return std::nullopt;
  return a0 + a * ((b0 - a0).cross(b) / cross);
}

double direction(cv::Point2d vector) { return std::atan2(vector.y, vector.x); }

/// A fitted line from its lower to its upper end.
struct FlankLine {
  cv::Point2d low;
  cv::Point2d high;
  bool is_left = true;
  cv::Scalar colour;
};

FlankLine flank_line(const Canvas& canvas, const Segment& line, bool is_left) {
  FlankLine result{canvas.at(line.from), canvas.at(line.to), is_left, is_left ? kOrange : kSkyBlue};
  if (result.low.y < result.high.y) std::swap(result.low, result.high);
  return result;
}

/// The angle between the ground and the line: an arc around their intersection, inside the heap.
void draw_angle(const Canvas& canvas, const FlankLine& flank, cv::Point2d foot,
                cv::Point2d along_ground) {
  const cv::Point2d uphill = flank.high - flank.low;
  if (along_ground.dot(uphill) < 0) along_ground = -along_ground;
  const double radius = 0.5 * cv::norm((flank.low + flank.high) / 2 - foot);
  const double from_rad = direction(along_ground);
  const double turn_rad = std::remainder(direction(uphill) - from_rad, 2 * std::numbers::pi);
  canvas.draw(arc(foot, radius, from_rad, from_rad + turn_rad), flank.colour, 0.7);
}

/// Where the flank's line meets the ground; std::nullopt if there is no ground or it is far away.
std::optional<cv::Point2d> foot_of(const Canvas& canvas, const FlankLine& flank,
                                   const std::optional<Segment>& ground) {
  if (!ground) return std::nullopt;
  const auto foot = meeting(flank.low, flank.high, canvas.at(ground->from), canvas.at(ground->to));
  const bool is_near = foot && cv::norm(*foot - flank.low) < canvas.length(2);
  return is_near ? foot : std::nullopt;
}

void draw_line(const Canvas& canvas, const FlankLine& flank, const std::optional<Segment>& ground,
               bool has_angle) {
  const cv::Point2d along = flank.high - flank.low;
  const auto met = foot_of(canvas, flank, ground);
  const cv::Point2d foot = met.value_or(flank.low - 0.25 * along);
  if (met && has_angle) {
    draw_angle(canvas, flank, foot, canvas.at(ground->to) - canvas.at(ground->from));
  }
  canvas.draw_dashed({flank.low, foot}, flank.colour, 0.7);
  canvas.draw_dashed({flank.high, flank.high + 0.3 * along}, flank.colour, 0.7);
  canvas.draw({flank.low, flank.high}, flank.colour, 1.1);
  const cv::Point2d tick =
      cv::Point2d(-along.y, along.x) * (canvas.length(0.014) / std::max(1.0, cv::norm(along)));
  for (const cv::Point2d end : {flank.low, flank.high}) {
    canvas.draw({end - tick, end + tick}, flank.colour, 0.9);
  }
}

/// A line of text on a dark plate, moved into the image if it would extend beyond it.
void draw_label(const Canvas& canvas, const Lettering& lettering, const std::string& text,
                cv::Point2d anchor, bool ends_at_anchor, const cv::Scalar& colour) {
  const int height = std::max(12, cvRound(canvas.length(0.042)));
  const int pad = height / 3;
  cv::Mat& image = canvas.image();
  const cv::Size plate(lettering.width(text, height) + 2 * pad, height + pad);
  cv::Point corner(cvRound(anchor.x) - (ends_at_anchor ? plate.width : 0),
                   cvRound(anchor.y) - plate.height);
  corner.x = std::clamp(corner.x, 0, std::max(0, image.cols - plate.width));
  corner.y = std::clamp(corner.y, 0, std::max(0, image.rows - plate.height));
  const cv::Rect box = cv::Rect(corner, plate) & cv::Rect({}, image.size());
  cv::Mat under = image(box);
  cv::addWeighted(under, 0.2, cv::Mat(under.size(), under.type(), kDark), 0.8, 0, under);
  cv::rectangle(image, cv::Rect(box.tl(), cv::Size(std::max(2, pad / 3), box.height)), colour,
                cv::FILLED);
  lettering.draw(image, text, corner + cv::Point(pad, pad / 2), height, kWhite);
}

void label_flank(const Canvas& canvas, const Lettering& lettering, const Flank& measured,
                 const FlankLine& flank) {
  if (!measured.angle_rad) return;
  const cv::Point2d along = flank.high - flank.low;
  cv::Point2d outward = cv::Point2d(along.y, -along.x) / std::max(1.0, cv::norm(along));
  if (outward.y > 0) outward = -outward;
  const cv::Point2d anchor = (flank.low + flank.high) / 2 + outward * canvas.length(0.035);
  draw_label(canvas, lettering, angle_text(*measured.angle_rad, measured.uncertainty_rad), anchor,
             flank.is_left, flank.colour);
}

/// The alternative result for a side with an apron: its line with the apron fully weighted.
void draw_apron(const Canvas& canvas, const Lettering& lettering, const FlankApron& apron,
                bool is_left) {
  constexpr double kShortDash = 0.006, kBelow = 0.07;
  const FlankLine line = flank_line(canvas, apron.line_with, is_left);
  canvas.draw_dashed({line.low, line.high}, line.colour, 0.5, kShortDash);
  draw_label(canvas, lettering,
             fmt::format("{:.1f}° with its apron", to_degrees(apron.angle_with_rad)),
             line.low + cv::Point2d(0, canvas.length(kBelow)), !is_left, line.colour);
}

void draw_ground(const Canvas& canvas, const Segment& ground) {
  const cv::Point2d from = canvas.at(ground.from), to = canvas.at(ground.to);
  const cv::Point2d beyond = 0.04 * (to - from);
  canvas.draw({from - beyond, to + beyond}, kYellow, 0.8);
}

/// Draws silhouette, ground line, fitted lines and angles into `image`, which is the measured
/// picture enlarged `scale` times.
void draw_marks(cv::Mat& image, double scale, const ReposeAngle& measured,
                const OverlayNotes& notes, const Lettering& lettering) {
  const Canvas canvas(image, scale);
  dim_outside(canvas, measured.outline);
  for (const Box& box : notes.excluded) draw_excluded(canvas, box);
  draw_hints(canvas, notes.hints);
  if (!measured.outline.empty()) canvas.draw(canvas.path_of(measured.outline), kWhite, 0.6, true);
  if (measured.ground) draw_ground(canvas, *measured.ground);

  std::vector<std::pair<const Flank*, FlankLine>> flanks;
  for (const Flank* flank : {&measured.left, &measured.right}) {
    if (!flank->line) continue;
    flanks.emplace_back(flank, flank_line(canvas, *flank->line, flank == &measured.left));
  }
  for (const auto& [flank, line] : flanks)
    draw_line(canvas, line, measured.ground, flank->angle_rad.has_value());
  for (const auto& [flank, line] : flanks) {
    if (flank->apron) draw_apron(canvas, lettering, *flank->apron, line.is_left);
  }
  for (const auto& [flank, line] : flanks) label_flank(canvas, lettering, *flank, line);
}

}  // namespace

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

OverlaidArea area_in_overlay(const Picture& picture, const Picture& overlay) {
  const double scale = drawing_scale(picture);
  const double width = std::max(1, cvRound(picture.width * scale));
  const double height = std::max(1, cvRound(picture.height * scale));
  return {.left = std::floor((overlay.width - width) / 2) / overlay.width,
          .width = width / overlay.width,
          .height = height / overlay.height};
}

}  // namespace repose::vision
